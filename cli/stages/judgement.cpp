// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/judgement.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

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

std::vector<std::string> paths_of(const CertificateRequest& request,
                                  const Certificate& certificate) {
    if (!request.files.inputs.empty()) return request.files.inputs;
    std::vector<std::string> paths;
    for (const CertifiedInput& input : certificate.inputs)
        paths.push_back(path_of(request, input.name));
    return paths;
}

/// Reads and parses one input file. A file whose hash differs from the certificate's need not
/// parse: the verifier rejects it by its hash.
Result<InputFile> read_input(const std::string& path, const CertifiedInput& stated,
                             const FileOptions& options) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    const auto format =
        options.input_format.empty() ? format_of(stated.name) : format_named(options.input_format);
    if (!format)
        return Error{ErrorCode::unknown_format, "no format that can be read has this extension",
                     stated.name};
    auto surfaces = parse_surfaces(contents.value(), stated.name, *format, options.read);
    InputFile file = input_file(contents.value(), {});
    if (surfaces)
        file.surfaces = std::move(surfaces.value());
    else if (file.sha256 == stated.sha256)
        return surfaces.error();
    return file;
}

Result<std::vector<InputFile>> read_certified_files(const CertificateRequest& request,
                                                    const Certificate& certificate) {
    const auto paths = paths_of(request, certificate);
    if (paths.size() != certificate.inputs.size())
        return Error{ErrorCode::bad_option,
                     fmt::format("the certificate is about {}, not {}",
                                 counted(certificate.inputs.size(), "file"), paths.size()),
                     request.certificate};
    std::vector<std::optional<Format>> formats;
    for (const CertifiedInput& input : certificate.inputs)
        formats.push_back(request.files.input_format.empty()
                              ? format_of(input.name)
                              : format_named(request.files.input_format));
    if (const auto sound = check_reading(formats, request.files.read, {"--depth", "--max-edge"});
        !sound)
        return sound.error();
    std::vector<InputFile> files;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        auto file = read_input(paths[i], certificate.inputs[i], request.files);
        if (!file) return file.error();
        files.push_back(std::move(file.value()));
    }
    return files;
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

Result<std::vector<JudgedOutput>> judge_outputs(const CertificateRequest& request,
                                                const Certificate& certificate) {
    const auto& outputs = certificate.outputs;
    std::vector<JudgedOutput> judged;
    if (!request.outputs.empty() && outputs.empty())
        return Error{ErrorCode::bad_option, "the certificate names no output file", "--output"};
    OutputVerifier verifier(certificate);
    for (const std::string& path : request.outputs)
        judged.push_back(judge_output(verifier, output_like(certificate, path), path));
    if (request.outputs.empty())
        for (std::size_t i = 0; i < outputs.size(); ++i) {
            const auto path = path_of(request, outputs[i].name);
            judged.push_back(outputs[i].name == "-"
                                 ? JudgedOutput{i, "standard output", "give it with --output", {}}
                                 : judge_output(verifier, i, path));
        }
    return judged;
}

} // namespace

Result<Judgement> judge_certificate(const CertificateRequest& request) {
    const std::string name = request.certificate == "-" ? "standard input" : request.certificate;
    const auto text = read_file(request.certificate);
    if (!text) return text.error();
    auto certificate = parse_certificate(text.value(), name);
    if (!certificate) return certificate.error();
    const auto files = read_certified_files(request, *certificate);
    if (!files) return files.error();
    auto verdict = verify_certificate(files.value(), *certificate, request.options);
    Judgement judged{*std::move(certificate), std::move(verdict), {}};
    if (judged.verdict.violations.empty()) {
        auto outputs = judge_outputs(request, judged.certificate);
        if (!outputs) return outputs.error();
        judged.outputs = *std::move(outputs);
    }
    return judged;
}

} // namespace terrane::cli
