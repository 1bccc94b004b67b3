// SPDX-License-Identifier: LGPL-3.0-or-later
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/improve_measured.hpp>

#include "handles.hpp"
#include "improve_options.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

py::dict dict_of_improvement(const ImproveReport& r) {
    return py::dict("corners"_a = r.corners, "curves"_a = r.curves, "sheets"_a = r.sheets,
                    "splits"_a = r.splits, "collapses"_a = r.collapses, "swaps"_a = r.swaps,
                    "moves"_a = r.moves, "refused_contact"_a = r.refused_contact,
                    "refused_deviation"_a = r.refused_deviation,
                    "refused_shape"_a = r.refused_shape, "least_quality"_a = r.least_quality,
                    "attempts"_a = r.attempts, "held_blocks"_a = r.held_blocks,
                    "passes"_a = r.passes, "sides_kept"_a = r.sides_kept,
                    "worst_cause"_a = to_text(name_of(r.worst_cause)));
}

py::tuple improve_mesh(const MeshPointer& mesh, const py::dict& options, const HowToRun& how) {
    if (!mesh->conforming) throw std::logic_error("a mesh without proof is improved");
    const auto made = run_stage(how, [mesh, o = to_improve_options(options)](const Run& run) {
        return improve_and_measure(*mesh->conforming, o, run);
    });
    const Improved& improved = made.improved;
    std::vector<std::array<double, 2>> deviations;
    for (const Deviation& d : made.deviations) deviations.push_back({d.out, d.back});
    return py::make_tuple(handle_of(improved.mesh, improved.conforming),
                          std::make_shared<Volumes>(improved.volumes), owned(improved.near_of),
                          owned(improved.report.bound_of), owned(made.bounds_back),
                          owned(std::move(deviations)), dict_of_improvement(improved.report));
}

} // namespace

ImproveOptions to_improve_options(const py::dict& given) {
    ImproveOptions o;
    const auto set = [&](const char* name, auto& value) {
        if (given.contains(name)) value = given[name].cast<std::remove_cvref_t<decltype(value)>>();
    };
    set("edge_length", o.edge_length);
    set("edge_length_of", o.edge_length_of);
    set("max_deviation", o.max_deviation);
    set("curve_length", o.curve_length);
    set("turn", o.turn);
    set("layers_in_gaps", o.layers_in_gaps);
    set("smallest", o.smallest);
    set("growth", o.growth);
    set("crease_angle", o.crease_angle);
    set("curve_angle", o.curve_angle);
    set("passes", o.passes);
    set("thickness_share", o.thickness_share);
    set("least_quality", o.least_quality);
    set("max_volume_change", o.max_volume_change);
    set("max_triangles", o.max_triangles);
    return o;
}

void bind_improve(py::module_& module) {
    module.def("improve", &improve_mesh, "mesh"_a, "options"_a, "how"_a);
    module.def(
        "distance",
        [](const py::sequence& from, const py::sequence& to, const HowToRun& how) {
            auto first = std::make_shared<const std::vector<Surface>>(to_surfaces(from));
            auto second = std::make_shared<const std::vector<Surface>>(to_surfaces(to));
            return run_plainly(how, [first, second](const Run& run) {
                return measured_distance(first->at(0), second->at(0), run);
            });
        },
        "from_surface"_a, "to_surface"_a, "how"_a);
}

} // namespace terrane::python
