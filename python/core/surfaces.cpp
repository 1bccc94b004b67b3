// SPDX-License-Identifier: LGPL-3.0-or-later
#include "surfaces.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/io/text/values.hpp>

#include "arrays.hpp"
#include "handles.hpp"

namespace terrane::python {

using namespace py::literals;

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

/// The corners of triangles, which name vertices. `Index` is the type of the array.
template <class Index>
std::vector<Triangle> to_triangles(const py::array& array, std::size_t vertices,
                                   const std::string& owner) {
    std::vector<Triangle> triangles;
    const auto rows = copied<std::array<Index, 3>>(array);
    triangles.reserve(rows.size());
    for (const auto& row : rows) {
        Triangle& corners = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = static_cast<std::uint32_t>(row[i]);
            if (row[i] >= 0 && static_cast<std::uint64_t>(row[i]) < vertices) continue;
            refuse(ErrorCode::bad_index,
                   "names a vertex that does not exist: [" + std::to_string(row[0]) + ", " +
                       std::to_string(row[1]) + ", " + std::to_string(row[2]) + "], of " +
                       std::to_string(vertices) + " vertices",
                   owner + "triangles[" + std::to_string(triangles.size() - 1) + "]");
        }
    }
    return triangles;
}

std::vector<Triangle> to_triangles(const py::array& array, std::size_t vertices,
                                   const std::string& owner) {
    const bool is_signed = array.dtype().kind() == 'i';
    if (array.itemsize() == 4)
        return is_signed ? to_triangles<std::int32_t>(array, vertices, owner)
                         : to_triangles<std::uint32_t>(array, vertices, owner);
    return is_signed ? to_triangles<std::int64_t>(array, vertices, owner)
                     : to_triangles<std::uint64_t>(array, vertices, owner);
}

/// Returns an array of values from (name, on_triangles, rows of numbers, unit, no_data, texts), which Python has
/// judged.
ValueArray to_values(const py::tuple& from) {
    auto rows = from[2].cast<py::array>();
    ValueArray made{.name = from_text(from[0]), .on_triangles = from[1].cast<bool>()};
    made.components = static_cast<std::uint32_t>(rows.shape(1));
    made.unit = from_text(from[3]);
    made.no_data = from[4].cast<std::optional<double>>();
    for (const py::handle text : from[5]) made.texts.push_back(from_text(text));
    const std::string type = py::str(rows.dtype());
    for (int t = 0; t <= static_cast<int>(NumberType::uint64); ++t)
        if (name_of(static_cast<NumberType>(t)) == type) made.type = static_cast<NumberType>(t);
    detail::with_type(made.type, [&]<class T>(T) {
        const auto numbers = copied<T>(rows.reshape({-1}));
        if constexpr (std::is_floating_point_v<T>)
            made.numbers.emplace<0>(numbers.begin(), numbers.end());
        else {
            auto& integers = made.numbers.emplace<1>();
            for (const T n : numbers) integers.push_back(static_cast<std::int64_t>(n));
        }
    });
    return made;
}

py::list from_values(const Surface& surface) {
    py::list all;
    for (const ValueArray& a : surface.arrays) {
        py::array rows = detail::with_type(a.type, [&]<class T>(T) -> py::array {
            std::vector<T> numbers;
            std::visit(
                [&](const auto& from) {
                    for (const auto n : from) numbers.push_back(static_cast<T>(n));
                },
                a.numbers);
            return owned(std::move(numbers));
        });
        const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(a.size()),
                                             static_cast<py::ssize_t>(a.components)};
        all.append(py::make_tuple(to_text(a.name), a.on_triangles, rows.reshape(shape),
                                  to_text(a.unit), a.no_data, to_texts(a.texts)));
    }
    return all;
}

/// Copies the arrays, and judges the copies: whoever can write to the arrays can't change what was judged.
std::shared_ptr<Surface> judged_surface(const py::array& vertices, const py::array& triangles,
                                        const py::object& name, const py::object& role,
                                        const py::tuple& frame, const py::sequence& values) {
    auto made = std::make_shared<Surface>();
    made->name = from_text(name);
    made->role = role_named(role);
    made->frame = to_frame(frame);
    const std::string owner = made->name.empty() ? "" : made->name + ": ";
    made->vertices = copied<Point3>(vertices);
    for (std::size_t v = 0; v < made->vertices.size(); ++v)
        if (!is_finite(made->vertices[v]))
            refuse(ErrorCode::bad_number, "a coordinate is not finite",
                   owner + "vertices[" + std::to_string(v) + "]");
    made->triangles = to_triangles(triangles, made->vertices.size(), owner);
    for (const py::handle array : values)
        made->arrays.push_back(to_values(py::cast<py::tuple>(array)));
    return made;
}

/// A copy with the same triangles, and what its file says of them.
std::shared_ptr<Surface> described_anew(const Surface& surface, const py::object& name,
                                        const py::object& role, const py::tuple& frame) {
    auto made = std::make_shared<Surface>(surface);
    made->name = from_text(name);
    made->role = role_named(role);
    made->frame = to_frame(frame);
    return made;
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
    for (const py::handle item : list) surfaces.push_back(item.cast<const Surface&>());
    return surfaces;
}

py::object from_surface(Surface surface) {
    return py::cast(std::make_shared<Surface>(std::move(surface)));
}

py::list from_surfaces(std::vector<Surface> surfaces) {
    py::list all;
    for (Surface& surface : surfaces) all.append(from_surface(std::move(surface)));
    return all;
}

py::list to_list(const std::vector<SurfaceInfo>& surfaces) {
    return rows(surfaces, &SurfaceInfo::name,
                [](const SurfaceInfo& s) { return std::string(name_of(s.role)); });
}

py::list to_list(const std::vector<PlausibilityWarning>& doubts) {
    return rows(
        doubts, [](const PlausibilityWarning& w) { return std::string(name_of(w.doubt)); },
        [](const PlausibilityWarning& w) {
            return std::vector<std::uint32_t>(w.surfaces.begin(), w.surfaces.end());
        },
        &PlausibilityWarning::seen, &PlausibilityWarning::why, &PlausibilityWarning::answer);
}

std::vector<SurfaceInfo> to_infos(const py::sequence& list) {
    std::vector<SurfaceInfo> infos;
    for (const py::handle item : list) {
        const auto pair = item.cast<py::tuple>();
        infos.push_back({from_text(pair[0]), role_named(pair[1])});
    }
    return infos;
}

void bind_surface(py::module_& module) {
    py::class_<Surface, std::shared_ptr<Surface>> bound(module, "Surface");
    bound
        .def(py::init(&judged_surface), "vertices"_a, "triangles"_a, "name"_a, "role"_a, "frame"_a,
             "values"_a)
        .def_property_readonly("values", &from_values)
        .def("described_anew", &described_anew, "name"_a, "role"_a, "frame"_a)
        .def_property_readonly("name", [](const Surface& s) { return to_text(s.name); })
        .def_property_readonly("role", [](const Surface& s) { return to_text(name_of(s.role)); })
        .def_property_readonly("frame", [](const Surface& s) { return from_frame(s.frame); });
    arrays_of(bound, std::identity())
        .add("vertices", &Surface::vertices)
        .add("triangles", &Surface::triangles);
    module.def(
        "doubts",
        [](const py::sequence& surfaces) { return to_list(find_doubts(to_surfaces(surfaces))); },
        "surfaces"_a);
}

} // namespace terrane::python
