// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
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

/// (name, verdict, sentence, count, size, flaws) of each property.
py::list properties_list(const MeshJudgement& found) {
    py::list properties;
    for (const JudgedProperty& p : found.properties)
        properties.append(py::make_tuple(to_text(p.name), to_text(std::string(name_of(p.verdict))),
                                         to_text(p.sentence), p.count, p.size,
                                         flaws_list(p.flaws)));
    return properties;
}

/// The properties of surfaces. Without inputs the triangles are judged alone.
py::list judge_surfaces(const py::sequence& output, const std::optional<py::sequence>& inputs,
                        const std::optional<std::string>& operation, double spacings,
                        std::size_t most_flaws, const HowToRun& how) {
    JudgeOptions options{.spacings = spacings, .most_flaws = most_flaws};
    if (operation) options.operation = operation_named(*operation);
    const auto made = to_surfaces(output);
    const auto given = inputs ? to_surfaces(*inputs) : std::vector<Surface>();
    const bool alone = !inputs;
    return properties_list(run_stage(how, [=](const Run& run) {
        return alone ? judge_soup(made, options, run) : judge(made, given, options, run);
    }));
}

/// The same of tetrahedra, with a label each, or none at all.
py::list judge_cells(const py::array& vertices, const py::array& tetrahedra,
                     const py::array& labels, const py::sequence& inputs, double spacings,
                     std::size_t most_flaws, const HowToRun& how) {
    const LabelledTetrahedra made{copied<Point3>(vertices),
                                  copied<std::array<std::uint32_t, 4>>(tetrahedra),
                                  copied<std::uint32_t>(labels)};
    const auto given = to_surfaces(inputs);
    const JudgeOptions options{.spacings = spacings, .most_flaws = most_flaws};
    return properties_list(
        run_stage(how, [=](const Run& run) { return judge(made, given, options, run); }));
}

} // namespace

void bind_judge(py::module_& module) {
    module.def("judge", &judge_surfaces, "output"_a, "inputs"_a, "operation"_a, "spacings"_a,
               "most_flaws"_a, "how"_a);
    module.def("judge_tetrahedra", &judge_cells, "vertices"_a, "tetrahedra"_a, "labels"_a,
               "inputs"_a, "spacings"_a, "most_flaws"_a, "how"_a);
}

} // namespace terrane::python
