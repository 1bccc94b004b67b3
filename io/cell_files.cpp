// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/cell_files.hpp>

#include <array>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/meshes/vti.hpp>

namespace terrane {
namespace {

Result<std::string> text_of_cells(const RectilinearGrid& grid, const BlocksInCells& found,
                                  const CellNames& names, CellFormat format) {
    switch (format) {
    case CellFormat::vti:
        return to_vti(grid, found, names);
    case CellFormat::vtr:
        return to_vtr(grid, found, names);
    case CellFormat::grdecl:
        return cells_to_grdecl(grid, found, names);
    default:
        return cells_to_csv(grid, found, names);
    }
}

} // namespace

std::optional<CellFormat> cell_format(std::string_view extension) {
    constexpr std::array<std::pair<std::string_view, CellFormat>, 4> formats{
        {{".vti", CellFormat::vti},
         {".vtr", CellFormat::vtr},
         {".grdecl", CellFormat::grdecl},
         {".csv", CellFormat::csv}}};
    for (const auto& [name, format] : formats)
        if (extension == name) return format;
    return std::nullopt;
}

Status write_cells(const RectilinearGrid& grid, const BlocksInCells& found, const CellNames& names,
                   CellFormat format, const std::filesystem::path& path) {
    return guard_memory("", [&]() -> Status {
        const auto text = text_of_cells(grid, found, names, format);
        if (!text) return Error{text.error().code, text.error().sentence, path.string()};
        return write_file(path, *text);
    });
}

} // namespace terrane
