// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surfaces.hpp"

#include <array>
#include <string>
#include <utility>

#include "arrays.hpp"

namespace terrane::python {
namespace {

constexpr std::array<std::string_view, 4> roles{"unknown", "horizon", "fault", "boundary"};

py::tuple from_frame(const CoordinateFrame& frame) {
    return py::make_tuple(to_text(frame.horizontal_unit), to_text(frame.vertical_unit),
                          to_text(frame.system), static_cast<int>(frame.vertical_axis),
                          frame.column_of_depths);
}

CoordinateFrame to_frame(const py::tuple& frame) {
    return {from_text(frame[0]), from_text(frame[1]), from_text(frame[2]),
            static_cast<VerticalAxis>(frame[3].cast<int>()), frame[4].cast<bool>()};
}

} // namespace

std::string_view name_of(Role role) {
    return roles[static_cast<std::size_t>(role)];
}

Role role_named(py::handle name) {
    const std::string text = from_text(name);
    for (std::size_t i = 0; i < roles.size(); ++i)
        if (roles[i] == text) return static_cast<Role>(i);
    throw py::value_error("no role is called " + text);
}

std::vector<Surface> to_surfaces(const py::sequence& list) {
    std::vector<Surface> surfaces;
    surfaces.reserve(list.size());
    for (const py::handle item : list) {
        const auto parts = item.cast<py::tuple>();
        Surface surface;
        surface.name = from_text(parts[0]);
        surface.role = role_named(parts[1]);
        surface.vertices = copied<Point3>(parts[2].cast<py::array>());
        surface.triangles = copied<Triangle>(parts[3].cast<py::array>());
        surface.frame = to_frame(parts[4].cast<py::tuple>());
        surfaces.push_back(std::move(surface));
    }
    return surfaces;
}

py::tuple from_surface(Surface surface) {
    return py::make_tuple(to_text(surface.name), to_text(name_of(surface.role)),
                          owned(std::move(surface.vertices)), owned(std::move(surface.triangles)),
                          from_frame(surface.frame));
}

py::list from_surfaces(std::vector<Surface> surfaces) {
    py::list all;
    for (Surface& surface : surfaces) all.append(from_surface(std::move(surface)));
    return all;
}

py::list to_list(const std::vector<SurfaceInfo>& surfaces) {
    py::list all;
    for (const SurfaceInfo& s : surfaces)
        all.append(py::make_tuple(to_text(s.name), to_text(name_of(s.role))));
    return all;
}

std::vector<SurfaceInfo> to_infos(const py::sequence& list) {
    std::vector<SurfaceInfo> infos;
    for (const py::handle item : list) {
        const auto pair = item.cast<py::tuple>();
        infos.push_back({from_text(pair[0]), role_named(pair[1])});
    }
    return infos;
}

} // namespace terrane::python
