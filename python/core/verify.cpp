// SPDX-License-Identifier: LGPL-3.0-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/stoppable.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/verifier_input.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

namespace fs = std::filesystem;

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

/// An output file as it was found.
struct JudgedFile {
    std::string path;
    std::string check; ///< "missing: ..." where it could not be read
    std::vector<Violation> violations;
};

/// What is found about a certificate and the files that it names.
struct Judgement {
    std::vector<Violation> violations;
    std::vector<JudgedFile> outputs;
    std::optional<Measured> measured;
    std::string digest;
};

std::vector<JudgedFile> judge_outputs(const Certificate& certificate, const fs::path& folder) {
    constexpr std::array<const char*, 4> checks{"every byte", "inflated", "float32", "hash only"};
    OutputVerifier verifier(certificate);
    std::vector<JudgedFile> judged;
    for (std::size_t i = 0; i < certificate.outputs.size(); ++i) {
        const fs::path path = folder / certificate.outputs[i].name;
        const auto contents = read_file(path);
        if (!contents) {
            judged.push_back({path.string(), "missing: " + contents.error().sentence, {}});
            continue;
        }
        auto verdict = verifier(*contents, i);
        judged.push_back({path.string(), checks[static_cast<std::size_t>(verdict.check)],
                          std::move(verdict.violations)});
    }
    return judged;
}

Judgement judge(const fs::path& path, const std::vector<std::string>& inputs,
                const VerifyOptions& options) {
    const auto text = must(read_file(path));
    const auto certificate = must(parse_certificate(text, path.string()));
    std::vector<fs::path> paths(inputs.begin(), inputs.end());
    if (paths.empty())
        for (const CertifiedInput& input : certificate.inputs)
            paths.push_back(path.parent_path() / input.name);
    const auto files = must(read_certified(certificate, paths, {.paths_name = "inputs"}));
    auto verdict = verify_certificate(files, certificate, options);
    Judgement found{std::move(verdict.violations), {}, verdict.measured, certificate.digest};
    if (found.violations.empty()) found.outputs = judge_outputs(certificate, path.parent_path());
    return found;
}

py::dict verify_file(const py::object& path, const py::sequence& inputs,
                     std::optional<double> max_deviation, std::optional<double> max_change,
                     const HowToRun& how) {
    const fs::path from = to_path(path);
    const VerifyOptions options{max_deviation, max_change};
    std::vector<std::string> given;
    for (const py::handle input : inputs) given.push_back(to_path(input).string());
    const auto found =
        run_verifier(how, [=]() -> Result<Judgement> { return judge(from, given, options); });
    py::list outputs;
    for (const JudgedFile& file : found.outputs)
        outputs.append(
            py::make_tuple(to_text(file.path), to_text(file.check), to_list(file.violations)));
    py::object deviation = py::none();
    if (found.measured) deviation = py::float_(found.measured->deviation);
    return py::dict("violations"_a = to_list(found.violations), "outputs"_a = outputs,
                    "deviation"_a = deviation, "digest"_a = found.digest);
}

} // namespace

void bind_verify(py::module_& module) {
    module.def("verify_arrangement", &verify_made, "surfaces"_a, "arrangement"_a, "how"_a);
    module.def("verify_mesh", &verify_mesh, "mesh"_a, "how"_a);
    module.def("verify_file", &verify_file, "path"_a, "inputs"_a, "max_deviation"_a, "max_change"_a,
               "how"_a);
}

} // namespace terrane::python
