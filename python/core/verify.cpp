// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/stoppable.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/judgement/judgement.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

/// (rule, elements, sentence)
py::list to_list(const std::vector<Violation>& violations) {
    return rows(violations, &Violation::rule, &Violation::elements, &Violation::sentence);
}

/// Runs work() -> Result<T> of the verifier, which hears a stop.
template <class Work>
auto run_verifier(const HowToRun& how, Work work) {
    return run_stage(
        how, [work = std::move(work)](const Run& run) { return stoppable(run.stop, work); });
}

py::list verify_made(const py::sequence& surfaces, const ArrangementPointer& a,
                     const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    return to_list(run_verifier(how, [given, a]() -> Result<std::vector<Violation>> {
        return verify_arrangement(*given, claim_of(*a));
    }));
}

py::list verify_mesh(const MeshPointer& mesh, const HowToRun& how) {
    return to_list(run_verifier(how, [mesh]() -> Result<std::vector<Violation>> {
        return verify_conforming(mesh->mesh->vertices, mesh->mesh->triangles);
    }));
}

/// "every byte", "inflated", ..., "missing: ..." where it could not be read
std::string check_of(const JudgedOutput& output) {
    constexpr std::array<const char*, 4> checks{"every byte", "inflated", "float32", "hash only"};
    return output.missing.empty() ? checks[static_cast<std::size_t>(output.verdict.check)]
                                  : "missing: " + output.missing;
}

py::dict verify_file(const py::object& path, const py::sequence& inputs,
                     std::optional<double> max_deviation, std::optional<double> max_change,
                     const std::optional<py::object>& folder, double time, double memory,
                     const HowToRun& how) {
    JudgementRequest request{.certificate = to_path(path),
                             .reading = {.paths_name = "inputs"},
                             .options = {max_deviation, max_change},
                             .limits = {time, memory}};
    if (folder) request.folder = to_path(*folder);
    for (const py::handle input : inputs) request.inputs.push_back(to_path(input));
    const auto found = run_stage(how, [=](const Run& run) { return judge(request, run.stop); });
    py::list outputs;
    for (const JudgedOutput& file : found.outputs)
        outputs.append(py::make_tuple(to_text(file.path), to_text(check_of(file)),
                                      to_list(file.verdict.violations)));
    py::object deviation = py::none();
    if (found.verdict.measured) deviation = py::float_(found.verdict.measured->deviation);
    return py::dict("violations"_a = to_list(found.verdict.violations), "outputs"_a = outputs,
                    "deviation"_a = deviation, "digest"_a = found.certificate.digest);
}

} // namespace

void bind_verify(py::module_& module) {
    module.def("verify_arrangement", &verify_made, "surfaces"_a, "arrangement"_a, "how"_a);
    module.def("verify_mesh", &verify_mesh, "mesh"_a, "how"_a);
    module.def("verify_file", &verify_file, "path"_a, "inputs"_a, "max_deviation"_a, "max_change"_a,
               "folder"_a, "time"_a, "memory"_a, "how"_a);
}

} // namespace terrane::python
