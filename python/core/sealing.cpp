// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/seal_advice.hpp>
#include <terrane/algorithms/model/seal_rules.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

using NamedDistances = std::vector<std::pair<std::string, double>>;

py::list to_list(const std::vector<SealChange>& changes) {
    py::list all;
    for (const SealChange& c : changes)
        all.append(py::make_tuple(c.kind == SealKind::extended ? "extended" : "trimmed",
                                  std::uint32_t(c.surface), c.length, c.largest, to_tuple(c.place),
                                  c.triangles));
    return all;
}

py::list to_list(const std::vector<OpenGap>& gaps) {
    py::list all;
    for (const OpenGap& g : gaps)
        all.append(py::make_tuple(std::uint32_t(g.from), std::uint32_t(g.to),
                                  to_text(name_of(g.reason)), g.edges, g.length, g.width,
                                  to_tuple(g.place)));
    return all;
}

py::list to_list(const std::vector<ClosedGap>& gaps) {
    py::list all;
    for (const ClosedGap& g : gaps)
        all.append(py::make_tuple(std::uint32_t(g.from), std::uint32_t(g.to), g.length, g.width,
                                  to_tuple(g.place)));
    return all;
}

NamedDistances to_distances(const py::dict& given) {
    NamedDistances all;
    for (const auto& [name, distance] : given)
        all.emplace_back(from_text(name), distance.cast<double>());
    return all;
}

Result<Sealed> sealed(std::vector<Surface> surfaces, double distance, const NamedDistances& of,
                      const Run& run) {
    SealOptions options{.distance = distance};
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    for (const auto& [name, width] : of) {
        const auto rules = seal_rules_for(name, width, infos, labels);
        if (!rules) return Error{ErrorCode::bad_option, rules.error().sentence, "distance_of"};
        options.rules.insert(options.rules.end(), rules->begin(), rules->end());
    }
    return seal(std::move(surfaces), options, run);
}

py::tuple seal_all(const py::sequence& surfaces, double distance, const py::dict& distance_of,
                   const HowToRun& how) {
    auto given = std::make_shared<std::vector<Surface>>(to_surfaces(surfaces));
    auto made = run_stage(how, [given, distance, of = to_distances(distance_of)](const Run& run) {
        return sealed(std::move(*given), distance, of, run);
    });
    const py::dict report("changes"_a = to_list(made.changes), "closed"_a = to_list(made.closed),
                          "open"_a = to_list(made.open), "left"_a = made.left,
                          "passes"_a = made.passes);
    return py::make_tuple(std::make_shared<Arrangement>(std::move(made.arrangement)),
                          from_surfaces(std::move(made.surfaces)), report);
}

py::dict suggest(const py::sequence& surfaces, const py::sequence& boundary, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    auto around = std::make_shared<const std::vector<Surface>>(to_surfaces(boundary));
    const auto advice = run_stage(
        how, [given, around](const Run& run) { return advise_seal(*given, *around, {}, run); });
    py::list breaks, trials;
    for (const GapBreak& b : advice.choice.breaks)
        breaks.append(py::make_tuple(b.low, b.high, b.distance, b.gaps, b.length));
    for (const SealTrial& t : advice.trials)
        trials.append(py::make_tuple(t.distance, t.blocks, t.small, t.changes, t.triangles,
                                     t.length, t.left));
    return py::dict("distance"_a = advice.choice.distance, "breaks"_a = breaks, "trials"_a = trials,
                    "small_volume"_a = advice.small_volume);
}

} // namespace

py::dict to_dict(const SealReport& report) {
    return py::dict("distance"_a = report.distance, "changes"_a = to_list(report.changes),
                    "closed"_a = to_list(report.closed), "open"_a = to_list(report.open),
                    "left"_a = report.left);
}

void bind_sealing(py::module_& module) {
    module.def("seal", &seal_all, "surfaces"_a, "distance"_a, "distance_of"_a, "how"_a);
    module.def("suggest_seal", &suggest, "surfaces"_a, "boundary"_a, "how"_a);
}

} // namespace terrane::python
