// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

#include "fields.hpp"
#include "handles.hpp"
#include "surfaces.hpp"
#include "work_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

constexpr std::array<const char*, 3> kinds{"outer", "hole", "fault gap"};

py::tuple to_tuple_of(const BorderLoop& loop) {
    return py::make_tuple(kinds[static_cast<std::size_t>(loop.kind)], owned(loop.vertices),
                          loop.length, loop.area, to_tuple(loop.centre), loop.fault_throw,
                          loop.width);
}

py::list border_loops(const py::sequence& surfaces, double gap_slope, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    const auto loops = run_stage(how, [given, gap_slope](const Run& run) {
        return find_border_loops(given->at(0), run, {.slope = gap_slope});
    });
    py::list all;
    for (const BorderLoop& loop : loops) all.append(to_tuple_of(loop));
    return all;
}

FillOptions fill_options(const py::dict& given) {
    auto o = options_in<FillOptions>(given);
    o.method = given["method"].cast<std::string>() == "rbf" ? FillMethod::rbf : FillMethod::kriging;
    const auto model = given["model"].cast<std::string>();
    o.model = variogram_model_named(model);
    if (!o.model && model != "auto")
        refuse("is no model: auto, spherical, exponential, gaussian, power, matern",
               "model=" + model);
    if (!given["smoothing"].is_none()) o.smoothing = given["smoothing"].cast<double>();
    return o;
}

py::object to_object(const std::optional<FillReport>& r) {
    if (!r) return py::none();
    return py::make_tuple(r->data, r->interpolated, r->area, r->expected_error, r->validated_error,
                          to_text(r->model));
}

/// Fills the holes of one surface; `numbers` are those of the holes, or none for those that are wanted.
FillWork filled(const std::vector<Surface>& surfaces, const FillOptions& options,
                const std::optional<std::vector<std::size_t>>& numbers, const Run& run) {
    const std::vector<FillTask> tasks{{SurfaceId(0), options}};
    auto work = must(find_holes(surfaces, tasks, run));
    auto chosen = wanted_holes(work);
    if (numbers) {
        chosen.assign(work.holes.size(), false);
        for (const std::size_t n : *numbers) {
            if (n == 0 || n > chosen.size())
                refuse("there are " + std::to_string(chosen.size()) + " holes, from 1",
                       "holes=" + std::to_string(n));
            chosen[n - 1] = true;
        }
    }
    must(fill_holes(surfaces, chosen, work, run));
    const auto contacts = must(contacts_of_new(work, run));
    if (contacts.empty()) return work;
    const NewContact& c = contacts.front();
    refuse(ErrorCode::improper_contact,
           "new triangles meet other triangles: " + std::string(name_of(c.kind)),
           "hole " + std::to_string(c.hole));
}

py::tuple fill(const py::sequence& surfaces, const py::dict& options,
               const std::optional<std::vector<std::size_t>>& numbers, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    const auto work = std::make_shared<FillWork>(
        run_stage(how, [given, o = fill_options(options), numbers](const Run& run) {
            return filled(*given, o, numbers, run);
        }));
    py::list holes;
    for (const NumberedHole& h : work->holes)
        holes.append(py::make_tuple(h.number, to_tuple_of(loop_of(*work, h)), to_object(h.report),
                                    to_text(h.refused)));
    const HoledSurface& s = work->surfaces.at(0); // kept as it is for reports
    return py::make_tuple(from_surface(s.filled), s.given_vertices, s.given_triangles,
                          owned(s.deviation), owned(s.interpolated), holes, work);
}

} // namespace

void bind_fill(py::module_& module) {
    const py::class_<FillWork, WorkPointer> work(module, "FillWork"); // a handle for reports
    module.attr("fill_fields") = described<FillOptions>();
    module.def("border_loops", &border_loops, "surfaces"_a, "gap_slope"_a, "how"_a);
    module.def("fill", &fill, "surfaces"_a, "options"_a, "numbers"_a, "how"_a);
}

} // namespace terrane::python
