// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/vti.hpp>

#include <fmt/format.h>

#include <terrane/algorithms/maps/grid_frame.hpp>
#include <terrane/io/grids/grid_writers.hpp>
#include <terrane/io/meshes/detail/vtk_writer.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {

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
