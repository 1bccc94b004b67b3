// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/io/report_members.hpp>

#include "fields.hpp"
#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

py::dict dict_of_improvement(const ImproveReport& r) {
    auto all = dict_of(r);
    all["sides_kept"] = r.sides_kept;
    all["worst_cause"] = shown(r.worst_cause);
    return all;
}

py::dict dict_of_joined(const SimplifyReport& r) {
    py::list blocks;
    for (const ChangedBlock& b : r.blocks) blocks.append(dict_of(b));
    const auto contacts = [](const std::vector<ChangedContact>& list) {
        return rows(
            list, [](const ChangedContact& c) { return c.between[0]; },
            [](const ChangedContact& c) { return c.between[1]; }, &ChangedContact::is_new);
    };
    auto all = dict_of(r);
    all["blocks"] = blocks;
    all["block_contacts"] = contacts(r.block_contacts);
    all["surface_contacts"] = contacts(r.surface_contacts);
    all["vanished"] = r.vanished;
    all["kept_blocks"] = r.kept;
    all["deviations"] = rows(r.deviations, &Deviation::out, &Deviation::back);
    all["left_alone"] = rows(r.left);
    return all;
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
