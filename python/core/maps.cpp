// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/maps/maps.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <terrane/io/files.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// name, x, y, dx, dy, rotation, nx, ny
using Nodes =
    std::tuple<py::str, double, double, double, double, double, std::uint32_t, std::uint32_t>;

Grid to_grid(const Nodes& nodes) {
    const auto& [name, x, y, dx, dy, rotation, nx, ny] = nodes;
    return {from_text(name), x, y, nx, ny, dx, dy, rotation, {}};
}

Nodes nodes_of(const Grid& grid) {
    return {to_text(grid.name), grid.x, grid.y, grid.dx, grid.dy, grid.rotation, grid.nx, grid.ny};
}

Nodes nodes_over(const py::sequence& surfaces, double step) {
    return nodes_of(must(grid_over(to_surfaces(surfaces), step)));
}

Nodes nodes_in(const py::object& path, const HowToRun& how) {
    return nodes_of(run_stage(how, [from = to_path(path)](const Run&) { return read_grid(from); }));
}

py::tuple map_numbers(const py::sequence& surfaces, const std::string& number, const Nodes& nodes,
                      const py::sequence& to, const HowToRun& how) {
    const auto kind = map_kind_named(number);
    if (!kind)
        refuse("is not mapped: height, depth, dip, azimuth, thickness, distance",
               "number=" + number);
    const auto mapped = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    const auto other = std::make_shared<const std::vector<Surface>>(to_surfaces(to));
    auto made = run_stage(how, [=, grid = to_grid(nodes)](const Run& run) {
        return map_surface(*mapped, *kind, grid, *other, run);
    });
    return py::make_tuple(owned(std::move(made.grid.values)), made.sheets);
}

py::array map_thickness(const MeshPointer& mesh, const VolumesPointer& volumes,
                        const std::vector<std::uint32_t>& blocks, const Nodes& nodes,
                        const HowToRun& how) {
    std::vector<BlockId> chosen;
    for (const std::uint32_t block : blocks) chosen.emplace_back(block);
    auto made = run_stage(how, [=, grid = to_grid(nodes)](const Run&) {
        return map_blocks(mesh->mesh, *volumes, chosen, grid);
    });
    return owned(std::move(made.values));
}

void write_map(const Nodes& nodes, const py::array& values, const py::object& path,
               const std::optional<std::string>& format, const HowToRun& how) {
    auto grid = std::make_shared<Grid>(to_grid(nodes));
    grid->values = copied<double>(values);
    run_stage(how, [grid, to = to_path(path), chosen = to_format(format)](const Run&) {
        return write_grid(*grid, to, chosen);
    });
}

} // namespace

void bind_maps(py::module_& module) {
    module.def("nodes_over", &nodes_over, "surfaces"_a, "step"_a);
    module.def("nodes_in", &nodes_in, "path"_a, "how"_a);
    module.def("map", &map_numbers, "surfaces"_a, "number"_a, "nodes"_a, "to"_a, "how"_a);
    module.def("map_thickness", &map_thickness, "mesh"_a, "volumes"_a, "blocks"_a, "nodes"_a,
               "how"_a);
    module.def("write_grid", &write_map, "nodes"_a, "values"_a, "path"_a, "format"_a, "how"_a);
}

} // namespace terrane::python
