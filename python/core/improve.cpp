// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>

#include "fields.hpp"
#include "handles.hpp"
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

py::dict dict_of_joined(const SimplifyReport& r) {
    py::list blocks;
    for (const ChangedBlock& b : r.blocks)
        blocks.append(py::dict("block"_a = b.block, "volume"_a = b.volume, "parts"_a = b.parts,
                               "into"_a = b.into));
    const auto contacts = [](const std::vector<ChangedContact>& list) {
        return rows(
            list, [](const ChangedContact& c) { return c.between[0]; },
            [](const ChangedContact& c) { return c.between[1]; }, &ChangedContact::is_new);
    };
    const auto left = rows(r.left, &LeftAlone::distance, &LeftAlone::place, &LeftAlone::reason);
    const auto deviations = rows(r.deviations, &Deviation::out, &Deviation::back);
    return py::dict("length"_a = r.resolution, "max_move"_a = r.max_move, "corners"_a = r.corners,
                    "curves"_a = r.curves, "surfaces"_a = r.sheets, "divided"_a = r.divided,
                    "rounds"_a = r.rounds, "attempts"_a = r.attempts, "blocks"_a = blocks,
                    "block_contacts"_a = contacts(r.block_contacts),
                    "surface_contacts"_a = contacts(r.surface_contacts), "vanished"_a = r.vanished,
                    "kept_blocks"_a = r.kept, "deviations"_a = deviations, "left_alone"_a = left);
}

/// An improved mesh, and what was joined at a resolution before.
struct ImprovedMesh {
    ImprovedAndMeasured made;
    std::optional<SimplifyReport> joined;
};

ImprovedMesh improved_mesh(const MeshPointer& mesh, const Resolution& resolution,
                           ImproveOptions options, const Run& run) {
    if (resolution.length == 0) {
        auto made = must(improve_and_measure(*mesh->conforming, options, run));
        return ImprovedMesh{std::move(made), {}};
    }
    auto made = must(improve_at_resolution(*mesh->conforming, resolution, options, {}, run));
    return ImprovedMesh{std::move(made.improved), std::move(made.simplified.report)};
}

py::tuple improve_mesh(const MeshPointer& mesh, const py::dict& options, const HowToRun& how) {
    if (!mesh->conforming) throw std::logic_error("a mesh without proof is improved");
    const auto found = run_stage(how, [mesh, resolution = options_in<Resolution>(options),
                                       o = options_in<ImproveOptions>(options)](const Run& run) {
        return improved_mesh(mesh, resolution, o, run);
    });
    const ImprovedAndMeasured& made = found.made;
    const Improved& improved = made.improved;
    std::vector<std::array<double, 2>> deviations;
    for (const Deviation& d : made.deviations) deviations.push_back({d.out, d.back});
    return py::make_tuple(handle_of(improved.mesh, improved.conforming),
                          std::make_shared<Volumes>(improved.volumes), owned(improved.near_of),
                          owned(improved.report.bound_of), owned(made.bounds_back),
                          owned(std::move(deviations)), dict_of_improvement(improved.report),
                          found.joined ? py::object(dict_of_joined(*found.joined)) : py::none());
}

} // namespace

void bind_improve(py::module_& module) {
    module.attr("improve_fields") = described<ImproveOptions, Resolution>();
    module.def("improve", &improve_mesh, "mesh"_a, "options"_a, "how"_a);
    module.def(
        "distance",
        [](const py::sequence& from, const py::sequence& to, const HowToRun& how) {
            auto first = std::make_shared<const std::vector<Surface>>(to_surfaces(from));
            auto second = std::make_shared<const std::vector<Surface>>(to_surfaces(to));
            return run_stage(how, [first, second](const Run& run) {
                return measured_distance(first->at(0), second->at(0), run);
            });
        },
        "from_surface"_a, "to_surface"_a, "how"_a);
}

} // namespace terrane::python
