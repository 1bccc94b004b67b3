// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/seal_rules.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/io/report_members.hpp>

#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

using NamedDistances = std::vector<std::pair<std::string, double>>;

py::list to_list(const std::vector<ClosedGap>& gaps) {
    return rows(gaps, &ClosedGap::from, &ClosedGap::to, &ClosedGap::length, &ClosedGap::width,
                &ClosedGap::place);
}

NamedDistances to_distances(const py::dict& given) {
    NamedDistances all;
    for (const auto& [name, distance] : given)
        all.emplace_back(from_text(name), distance.cast<double>());
    return all;
}

Sealed sealed(std::vector<Surface> surfaces, double distance, const NamedDistances& of,
              const Run& run) {
    SealOptions options{.distance = distance};
    const auto infos = infos_of(surfaces);
    const auto labels = unique_labels(infos);
    for (const auto& [name, width] : of) {
        const auto rules = seal_rules_for(name, width, infos, labels);
        if (!rules) refuse(rules.error().sentence, "distance_of");
        options.rules.insert(options.rules.end(), rules->begin(), rules->end());
    }
    return must(seal(std::move(surfaces), options, run));
}

py::tuple seal_all(const py::sequence& surfaces, double distance, const py::dict& distance_of,
                   const HowToRun& how) {
    auto given = std::make_shared<std::vector<Surface>>(to_surfaces(surfaces));
    auto made = run_stage(how, [given, distance, of = to_distances(distance_of)](const Run& run) {
        return sealed(std::move(*given), distance, of, run);
    });
    const py::dict report("changes"_a = rows(made.changes), "closed"_a = to_list(made.closed),
                          "open"_a = rows(made.open), "left"_a = made.left,
                          "passes"_a = made.passes);
    return py::make_tuple(std::make_shared<Arrangement>(std::move(made.arrangement)),
                          from_surfaces(std::move(made.surfaces)), report);
}

py::dict suggest(const py::sequence& surfaces, const py::sequence& boundary, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    auto around = std::make_shared<const std::vector<Surface>>(to_surfaces(boundary));
    const auto advice = run_stage(
        how, [given, around](const Run& run) { return advise_seal(*given, *around, {}, run); });
    return py::dict("distance"_a = advice.choice.distance, "breaks"_a = rows(advice.choice.breaks),
                    "trials"_a = rows(advice.trials), "small_volume"_a = advice.small_volume);
}

} // namespace

py::dict to_dict(const SealReport& report) {
    return py::dict("distance"_a = report.distance, "changes"_a = rows(report.changes),
                    "closed"_a = to_list(report.closed), "open"_a = rows(report.open),
                    "left"_a = report.left);
}

void bind_sealing(py::module_& module) {
    module.def("seal", &seal_all, "surfaces"_a, "distance"_a, "distance_of"_a, "how"_a);
    module.def("suggest_seal", &suggest, "surfaces"_a, "boundary"_a, "how"_a);
}

} // namespace terrane::python
