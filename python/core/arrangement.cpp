// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/search/method.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/io/report_members.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

Search to_search(const std::string& name) {
    if (const auto search = search_named(name)) return *search;
    refuse(
        ErrorCode::bad_option,
        "is no method of search: auto, grid, ab, ab-balanced, ab-median, mixed, hierarchy, brute",
        "search=" + name);
}

ArrangementPointer arrange_all(const py::sequence& surfaces, const std::string& search,
                               const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    const ArrangeOptions options{.search = to_search(search)};
    return std::make_shared<Arrangement>(
        run_stage(how, [given, options](const Run& run) { return arrange(*given, options, run); }));
}

py::tuple rounded(const ArrangementPointer& arrangement, unsigned max_rounds,
                  std::optional<double> max_move, const HowToRun& how) {
    const RoundingOptions options{.max_rounds = max_rounds, .max_move = max_move};
    const auto made = run_stage(how, [arrangement, options](const Run& run) {
        return round_to_doubles(*arrangement, options, run);
    });
    return py::make_tuple(handle_of(made.mesh, made.conforming), to_list(made.regions),
                          to_dict(made.report));
}

/// The doubles nearest to the vertices.
py::array nearest(const Arrangement& a) {
    std::vector<Point3> points;
    points.reserve(a.vertices.size());
    for (std::uint32_t v = 0; v < a.vertices.size(); ++v) points.push_back(a.nearest(VertexId(v)));
    return owned(std::move(points));
}

py::dict statistics(const Arrangement& a) {
    const ArrangeStatistics& s = a.statistics;
    return py::dict("search"_a = std::string(name_of(s.search)), "candidates"_a = s.candidates,
                    "improper_contacts"_a = s.improper_contacts, "divided"_a = s.divided,
                    "constructed_points"_a = s.constructed_points, "triangles"_a = s.triangles,
                    "vertices"_a = s.vertices);
}

py::tuple construction(const Arrangement& a, std::uint32_t vertex) {
    constexpr std::array<const char*, 4> kinds{"input", "line_plane", "three_planes", "line_line"};
    constexpr std::array<std::size_t, 4> used{1, 5, 9, 4};
    require_below(vertex, a.vertices.size(), "vertex");
    const Construction c = a.construction(VertexId(vertex));
    const auto kind = static_cast<std::size_t>(c.kind);
    const std::vector<std::uint32_t> v(c.v.begin(), c.v.begin() + used[kind]);
    return py::make_tuple(kinds[kind], py::tuple(py::cast(v)));
}

std::string digest(const py::sequence& surfaces, const ArrangementPointer& arrangement,
                   const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    return run_stage(how, [given, arrangement](const Run& run) {
        return canonical_digest(*given, *arrangement, run);
    });
}

py::dict dict_of_cut(const VolumeReport& report) {
    const auto cuts = rows(report.surfaces, &SurfaceCut::area_inside, &SurfaceCut::area_outside,
                           &SurfaceCut::area_on_boundary, &SurfaceCut::pieces,
                           &SurfaceCut::open_length, &SurfaceCut::open_borders);
    return py::dict("surfaces"_a = cuts, "borders"_a = rows(report.borders));
}

py::tuple cut(const ArrangementPointer& arrangement, const std::vector<std::uint32_t>& boundary,
              const HowToRun& how) {
    for (const std::uint32_t s : boundary)
        require_below(s, arrangement->surfaces.size(), "surface");
    auto made = run_stage(how, [arrangement, boundary](const Run& run) {
        return cut_to_volume(*arrangement, boundary, run);
    });
    auto report = dict_of_cut(made.report);
    return py::make_tuple(std::make_shared<Arrangement>(std::move(made.arrangement)), report);
}

py::tuple extend(const py::sequence& surfaces, const std::vector<std::uint32_t>& boundary,
                 double limit, const HowToRun& how) {
    auto given = std::make_shared<std::vector<Surface>>(to_surfaces(surfaces));
    for (const std::uint32_t s : boundary) require_below(s, given->size(), "surface");
    auto made = run_stage(how, [given, boundary, limit](const Run& run) {
        return extend_to_boundary(std::move(*given), boundary, {.limit = limit}, run);
    });
    const auto borders =
        rows(made.borders, &ExtendedBorder::surface, &ExtendedBorder::reached,
             &ExtendedBorder::length, &ExtendedBorder::place, &ExtendedBorder::edges);
    return py::make_tuple(from_surfaces(std::move(made.surfaces)), borders);
}

void bind_boundaries(py::module_& module) {
    module.def(
        "box_boundary",
        [](const py::object& low, const py::object& high) {
            return from_surfaces(must(box_boundary(to_point(low), to_point(high))));
        },
        "low"_a, "high"_a);
    module.def(
        "rotated_box_boundary",
        [](const py::object& place, bool is_corner, const std::array<double, 3>& lengths,
           double azimuth, double plunge, double roll) {
            return from_surfaces(must(rotated_box_boundary(
                {to_point(place), is_corner, lengths, azimuth, plunge, roll})));
        },
        "place"_a, "is_corner"_a, "lengths"_a, "azimuth"_a, "plunge"_a, "roll"_a);
    module.def(
        "polygon_boundary",
        [](const py::array& corners, double low, double high) {
            return from_surfaces(must(polygon_boundary(copied<Point2>(corners), low, high)));
        },
        "corners"_a, "low"_a, "high"_a);
    module.def(
        "closed_boundary",
        [](const py::sequence& surfaces, const HowToRun& how) {
            auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
            return from_surfaces(
                run_stage(how, [given](const Run& run) { return closed_boundary(*given, run); }));
        },
        "surfaces"_a, "how"_a);
}

} // namespace

py::dict to_dict(const RoundingReport& r) {
    auto all = dict_of(r);
    all["clean"] = r.clean;
    all["rounds"] = r.rounds;
    all["contacts"] = to_list(r.contacts);
    all["vanished_regions"] = rows(r.vanished_regions, &VanishedRegions::surface,
                                   &VanishedRegions::exact, &VanishedRegions::rounded);
    all["vanished"] = owned(r.vanished);
    return all;
}

void bind_arrangement(py::module_& module) {
    py::class_<Arrangement, ArrangementPointer> bound(module, "Arrangement");
    bound
        .def_property_readonly("surfaces", [](const Arrangement& a) { return to_list(a.surfaces); })
        .def_property_readonly("statistics", &statistics)
        .def("nearest", &nearest)
        .def("coordinates",
             [](const Arrangement& a, std::uint32_t v) {
                 require_below(v, a.vertices.size(), "vertex");
                 return a.coordinates(VertexId(v));
             })
        .def("construction", &construction);
    using A = Arrangement;
    arrays_of(bound, std::identity())
        .add("points", &A::vertices)
        .add("triangles", &A::triangles)
        .add("intersection_edges", &A::intersection_edges)
        .add("degenerate", &A::degenerate)
        .add("parents_of", &A::parents_of)
        .add("surfaces_of", &A::surfaces_of);
    arrays_of(bound, &A::inputs)
        .add("duplicates", &InputTriangles::duplicates)
        .add("first_triangle", &InputTriangles::first)
        .add("first_vertex", &InputTriangles::first_vertex);
    module.def("arrange", &arrange_all, "surfaces"_a, "search"_a, "how"_a);
    module.def("round", &rounded, "arrangement"_a, "max_rounds"_a, "max_move"_a, "how"_a);
    module.def("digest", &digest, "surfaces"_a, "arrangement"_a, "how"_a);
    module.def("cut", &cut, "arrangement"_a, "boundary"_a, "how"_a);
    module.def("extend", &extend, "surfaces"_a, "boundary"_a, "limit"_a, "how"_a);
    module.def(
        "unique_labels",
        [](const py::sequence& surfaces) { return to_texts(unique_labels(to_infos(surfaces))); },
        "surfaces"_a);
    bind_boundaries(module);
}

} // namespace terrane::python
