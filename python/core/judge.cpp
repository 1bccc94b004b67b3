// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <string>
#include <vector>

#include <terrane/algorithms/judge/judge.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// (sentence, place, triangles, size)
py::list flaws_list(const std::vector<PropertyFlaw>& flaws) {
    return rows(flaws, &PropertyFlaw::sentence, &PropertyFlaw::place, &PropertyFlaw::triangles,
                &PropertyFlaw::size);
}

/// (name, verdict, sentence, count, size, flaws) of each property. Without inputs the triangles are judged alone.
py::list judge_surfaces(const py::sequence& output, const std::optional<py::sequence>& inputs,
                        const std::optional<std::string>& operation, double spacings,
                        std::size_t most_flaws, const HowToRun& how) {
    JudgeOptions options{.spacings = spacings, .most_flaws = most_flaws};
    if (operation) options.operation = operation_named(*operation);
    const auto made = to_surfaces(output);
    const auto given = inputs ? to_surfaces(*inputs) : std::vector<Surface>();
    const bool alone = !inputs;
    const auto found = run_stage(how, [=](const Run& run) {
        return alone ? judge_soup(made, options, run) : judge(made, given, options, run);
    });
    py::list properties;
    for (const JudgedProperty& p : found.properties)
        properties.append(py::make_tuple(to_text(p.name), to_text(std::string(name_of(p.verdict))),
                                         to_text(p.sentence), p.count, p.size,
                                         flaws_list(p.flaws)));
    return properties;
}

} // namespace

void bind_judge(py::module_& module) {
    module.def("judge", &judge_surfaces, "output"_a, "inputs"_a, "operation"_a, "spacings"_a,
               "most_flaws"_a, "how"_a);
}

} // namespace terrane::python
