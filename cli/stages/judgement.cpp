// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/judgement.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/verifier_input.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

fs::path folder_of(const CertificateRequest& request) {
    return request.certificate == "-" ? fs::path() : fs::path(request.certificate).parent_path();
}

/// Returns the path of a file that the certificate names. A folder that is still to get its name
/// cannot be gone through.
std::string path_of(const CertificateRequest& request, const std::string& name) {
    const fs::path folder = folder_of(request), path = folder / name;
    std::error_code failed;
    const bool is_there = folder.empty() || fs::is_directory(folder, failed);
    return (is_there ? path : path.lexically_normal()).string();
}

std::vector<InputFile> read_inputs(const CertificateRequest& request,
                                   const Certificate& certificate) {
    const FileOptions& given = request.files;
    if (!given.input_format.empty() && !format_named(given.input_format))
        refuse(ErrorCode::unknown_format, "unknown format " + given.input_format, "");
    std::vector<fs::path> paths(given.inputs.begin(), given.inputs.end());
    if (paths.empty())
        for (const CertifiedInput& input : certificate.inputs)
            paths.emplace_back(path_of(request, input.name));
    return must(read_certified(certificate, paths,
                               {format_named(given.input_format),
                                given.read,
                                request.certificate.c_str(),
                                {"--depth", "--max-edge"}}));
}

JudgedOutput judge_output(OutputVerifier& verifier, std::size_t number, const std::string& path) {
    JudgedOutput judged{number, path, {}, {}};
    const auto contents = read_file(path);
    if (contents)
        judged.verdict = verifier(contents.value(), number);
    else
        judged.missing = contents.error().sentence;
    return judged;
}

/// Returns the output that a file is compared with: the one with its bytes, else the one with its
/// extension, else the first.
std::size_t output_like(const Certificate& certificate, const std::string& path) {
    const auto& outputs = certificate.outputs;
    const auto found_if = [&](const auto& fits) {
        return static_cast<std::size_t>(std::ranges::find_if(outputs, fits) - outputs.begin());
    };
    if (const auto contents = read_file(path); contents) {
        const auto hash = input_file(contents.value(), {}).sha256;
        const auto same = found_if([&](const CertifiedOutput& o) { return o.sha256 == hash; });
        if (same < outputs.size()) return same;
    }
    const auto extension = fs::path(path).extension();
    const auto alike = found_if(
        [&](const CertifiedOutput& o) { return fs::path(o.name).extension() == extension; });
    return alike < outputs.size() ? alike : 0;
}

std::vector<JudgedOutput> judge_outputs(const CertificateRequest& request,
                                        const Certificate& certificate) {
    const auto& outputs = certificate.outputs;
    std::vector<JudgedOutput> judged;
    if (!request.outputs.empty() && outputs.empty())
        refuse("the certificate names no output file", "--output");
    OutputVerifier verifier(certificate);
    std::vector<bool> is_given(outputs.size());
    for (const std::string& path : request.outputs) {
        const std::size_t i = output_like(certificate, path);
        judged.push_back(judge_output(verifier, i, path));
        is_given[i] = true;
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (is_given[i]) continue;
        const auto path = path_of(request, outputs[i].name);
        judged.push_back(outputs[i].name == "-"
                             ? JudgedOutput{i, "standard output", "give it with --output", {}}
                             : judge_output(verifier, i, path));
    }
    return judged;
}

} // namespace

Judgement judge_certificate(const CertificateRequest& request) {
    const std::string name = request.certificate == "-" ? "standard input" : request.certificate;
    const auto text = must(read_file(request.certificate));
    auto certificate = must(parse_certificate(text, name));
    const auto files = read_inputs(request, certificate);
    auto verdict = verify_certificate(files, certificate, request.options);
    Judgement judged{std::move(certificate), std::move(verdict), {}};
    if (judged.verdict.violations.empty())
        judged.outputs = judge_outputs(request, judged.certificate);
    return judged;
}

} // namespace terrane::cli
