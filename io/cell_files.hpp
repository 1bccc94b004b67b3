// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids of cells as files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/cell_text.hpp>

namespace terrane {

/// The formats of grids of cells.
enum class CellFormat : std::uint8_t { vti, vtr, grdecl, csv };

/// Returns the format of an extension, ".vti"; nothing for others.
std::optional<CellFormat> cell_format(std::string_view extension);

/// Writes the cells of a grid and their blocks to a file, all or nothing; "-" is standard output. Errors: those of
/// to_vti() and write_file().
Status write_cells(const RectilinearGrid& grid, const BlocksInCells& found, const CellNames& names,
                   CellFormat format, const std::filesystem::path& path);

} // namespace terrane
