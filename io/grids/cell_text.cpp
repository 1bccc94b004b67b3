// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/cell_text.hpp>

#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/grids/detail/keyword_text.hpp>
#include <terrane/io/grids/grdecl_cells.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {
namespace {

using grids::detail::append_keyword;

double depth_of(double z) {
    return z == 0 ? 0 : -z;
}

/// Returns values of cells in the order of a corner-point grid, whose layers run downward.
template <class T, class ValueOf>
std::vector<T> from_above(const RectilinearGrid& grid, const ValueOf& value_of) {
    const auto [nx, ny, nz] = grid.counts();
    std::vector<T> values;
    values.reserve(grid.size());
    for (std::size_t k = nz; k-- > 0;)
        for (std::size_t c = k * nx * ny; c < (k + 1) * nx * ny; ++c) values.push_back(value_of(c));
    return values;
}

std::string_view unit_in_grdecl(std::string_view unit) {
    for (const auto& [known, name] : {std::pair<std::string_view, std::string_view>{"m", "METRES"},
                                      {"ft", "FEET"},
                                      {"cm", "CM"}})
        if (unit == known) return name;
    return {};
}

} // namespace

std::string cells_to_csv(const RectilinearGrid& grid, const BlocksInCells& found,
                         const CellNames& names) {
    const auto [nx, ny, nz] = grid.counts();
    std::string out = "i,j,k,x,y,z,block,name,unit,fraction,centre\n";
    for (std::size_t c = 0; c < grid.size(); ++c) {
        const Point3 p = grid.centre(c);
        for (std::size_t s = found.first[c]; s < found.first[c + 1]; ++s) {
            const auto& [block, fraction] = found.shares[s];
            if (block == 0) continue;
            out += fmt::format("{},{},{}", c % nx + 1, c / nx % ny + 1, c / nx / ny + 1);
            for (const double number : {p.x, p.y, p.z}) {
                out += ',';
                detail::append_number(out, number);
            }
            out += fmt::format(",{},{},{},", std::uint32_t(block),
                               detail::csv_field(names.blocks[block]),
                               detail::csv_field(names.units[block]));
            detail::append_number(out, fraction);
            out += found.block_of[c] == block ? ",1\n" : ",0\n";
        }
    }
    return out;
}

CornerPointGrid corner_points_of(const RectilinearGrid& grid, const BlocksInCells& found) {
    const auto [nx, ny, nz] = grid.counts();
    CornerPointGrid made;
    made.nx = static_cast<std::uint32_t>(nx);
    made.ny = static_cast<std::uint32_t>(ny);
    made.nz = static_cast<std::uint32_t>(nz);
    const double top = depth_of(grid.z.back()), base = depth_of(grid.z.front());
    for (const double y : grid.y)
        for (const double x : grid.x) made.pillars.push_back({x, y, top, x, y, base});
    for (std::size_t k = nz; k-- > 0;)
        for (const double z : {grid.z[k + 1], grid.z[k]})
            made.depths.insert(made.depths.end(), 4 * nx * ny, depth_of(z));
    made.active =
        from_above<char>(grid, [&](std::size_t c) { return char(found.block_of[c] == 0 ? 0 : 1); });
    return made;
}

std::string to_grdecl(const CornerPointGrid& grid, std::string_view comment) {
    std::string out = "-- " + detail::one_line(comment) + "\n";
    out += fmt::format("SPECGRID\n{} {} {} 1 F /\n\n", grid.nx, grid.ny, grid.nz);
    if (const auto unit = unit_in_grdecl(grid.frame.horizontal_unit); !unit.empty())
        out += fmt::format("GRIDUNIT\n{} MAP /\n\n", unit);
    out += "COORD\n";
    for (const auto& pillar : grid.pillars) {
        for (const double number : pillar) {
            detail::append_number(out, number == 0 ? 0 : number);
            out += ' ';
        }
        out.back() = '\n';
    }
    out += "/\n\n";
    append_keyword(out, "ZCORN", grid.depths, [](double depth) { return depth == 0 ? 0 : depth; });
    return out;
}

std::string cells_to_grdecl(const RectilinearGrid& grid, const BlocksInCells& found,
                            const CellNames& names) {
    CornerPointGrid made = corner_points_of(grid, found);
    made.frame.horizontal_unit = names.length_unit;
    const auto blocks =
        from_above<std::uint32_t>(grid, [&](std::size_t c) { return found.block_of[c]; });
    const auto inside =
        from_above<double>(grid, [&](std::size_t c) { return 1 - found.fraction(c, BlockId(0)); });
    std::string out = to_grdecl(made, "A grid of the blocks of " + names.source);
    out += '\n' + cells_to_grdecl(blocks, names.blocks, names.source);
    out += "\n-- the part of a cell in blocks\n";
    append_keyword(out, "MULTPV", inside, [](double part) { return part; });
    return out;
}

} // namespace terrane
