// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vti.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/maps/grid_frame.hpp>
#include <terrane/io/grids/grid_writers.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {
namespace {

std::string extent_of_cells(const RectilinearGrid& grid) {
    const auto [nx, ny, nz] = grid.counts();
    return fmt::format("0 {} 0 {} 0 {}", nx, ny, nz);
}

/// Returns the distance of the planes across an axis.
Result<double> step_of(const std::vector<double>& planes, const char* axis) {
    const double first = planes.front(), steps = double(planes.size() - 1);
    const double step = planes.back() / steps - first / steps;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() *
                            std::max(std::fabs(first), std::fabs(planes.back()));
    for (std::size_t i = 0; i < planes.size(); ++i)
        if (!(std::fabs(first + double(i) * step - planes[i]) <= rounding))
            return Error{
                ErrorCode::unsupported,
                fmt::format("the planes across {} are not equally far apart; .vtr has such", axis),
                ""};
    return step;
}

/// Returns the index of each block's unit, and the units.
std::pair<std::vector<std::int32_t>, std::vector<std::string_view>>
units_of(const CellNames& names) {
    std::vector<std::int32_t> unit_of;
    std::vector<std::string_view> units;
    for (const std::string& unit : names.units) {
        const auto at = std::find(units.begin(), units.end(), unit);
        unit_of.push_back(unit.empty() ? -1 : static_cast<std::int32_t>(at - units.begin()));
        if (!unit.empty() && at == units.end()) units.emplace_back(unit);
    }
    return {unit_of, units};
}

void write_shares(detail::VtkWriter& out, const BlocksInCells& found, const CellNames& names) {
    std::vector<std::int64_t> cells;
    std::vector<std::uint32_t> blocks;
    std::vector<double> fractions;
    for (std::size_t c = 0; c < found.block_of.size(); ++c) {
        if (found.first[c + 1] - found.first[c] < 2) continue;
        for (std::size_t s = found.first[c]; s < found.first[c + 1]; ++s) {
            cells.push_back(static_cast<std::int64_t>(c));
            blocks.push_back(found.shares[s].block);
            fractions.push_back(found.shares[s].fraction);
        }
    }
    out.begin_field();
    out.strings("block_name", {names.blocks.begin(), names.blocks.end()});
    if (const auto units = units_of(names).second; !units.empty()) out.strings("unit_name", units);
    out.array("share_cell", cells);
    out.array("share_block", blocks);
    out.array("share_fraction", fractions);
    out.end_field();
}

void write_cells(detail::VtkWriter& out, const RectilinearGrid& grid, const BlocksInCells& found,
                 const CellNames& names) {
    const auto unit_of = units_of(names).first;
    std::vector<std::uint32_t> blocks;
    std::vector<std::int32_t> units;
    std::vector<double> fractions;
    for (std::size_t c = 0; c < grid.size(); ++c) {
        const BlockId block = found.block_of[c];
        blocks.push_back(block);
        units.push_back(unit_of[block]);
        fractions.push_back(found.fraction(c, block));
    }
    out.text(fmt::format("<Piece Extent=\"{}\">\n<PointData>\n</PointData>\n"
                         "<CellData Scalars=\"block\">",
                         extent_of_cells(grid)));
    out.array("block", blocks);
    out.array("unit", units);
    out.array("fraction", fractions);
    out.text("</CellData>");
}

} // namespace

Result<std::string> to_vti(const RectilinearGrid& grid, const BlocksInCells& found,
                           const CellNames& names) {
    std::array<double, 3> steps{};
    for (const auto& [axis, planes, name] :
         {std::tuple{0U, &grid.x, "x"}, {1U, &grid.y, "y"}, {2U, &grid.z, "z"}}) {
        const auto step = step_of(*planes, name);
        if (!step) return step.error();
        steps[axis] = *step;
    }
    detail::VtkWriter out(true);
    out.begin_file("ImageData",
                   fmt::format(" WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\"",
                               extent_of_cells(grid), grid.x[0], grid.y[0], grid.z[0], steps[0],
                               steps[1], steps[2]));
    write_shares(out, found, names);
    write_cells(out, grid, found, names);
    return out.end_file("ImageData");
}

std::string to_vtr(const RectilinearGrid& grid, const BlocksInCells& found,
                   const CellNames& names) {
    detail::VtkWriter out(true);
    out.begin_file("RectilinearGrid", fmt::format(" WholeExtent=\"{}\"", extent_of_cells(grid)));
    write_shares(out, found, names);
    write_cells(out, grid, found, names);
    out.text("<Coordinates>");
    out.array("x", grid.x);
    out.array("y", grid.y);
    out.array("z", grid.z);
    out.text("</Coordinates>");
    return out.end_file("RectilinearGrid");
}

Result<std::string> to_vti(const Grid& given) {
    const auto grid = upright(given);
    if (!grid) return grid.error();
    Grid unit; // its nodes are the directions of the axes
    unit.dx = unit.dy = 1;
    unit.rotation = grid->rotation;
    const Point3 along = GridFrame(unit).node(1, 0), across = GridFrame(unit).node(0, 1);
    const std::string extent = fmt::format("0 {} 0 {} 0 0", grid->nx - 1, grid->ny - 1);
    const std::string name = xml_escaped(grid->name.empty() ? "value" : grid->name);
    detail::VtkWriter out(true);
    out.begin_file("ImageData",
                   fmt::format(" WholeExtent=\"{}\" Origin=\"{} {} 0\" Spacing=\"{} {} 1\" "
                               "Direction=\"{} {} 0 {} {} 0 0 0 1\"",
                               extent, grid->x, grid->y, grid->dx, grid->dy, along.x, across.x,
                               along.y, across.y));
    out.text(fmt::format("<Piece Extent=\"{}\">\n<PointData Scalars=\"{}\">", extent, name));
    out.array(grid->name.empty() ? "value" : grid->name, grid->values);
    out.text("</PointData>\n<CellData>\n</CellData>");
    return out.end_file("ImageData");
}

} // namespace terrane
