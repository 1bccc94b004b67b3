// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/certificate_output.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/exact_text.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

void write(const std::string& path, const std::string& text, std::FILE* told, Session& session) {
    session.begin("write", Phase::writing);
    must(write_file(path, text));
    session.end_stage();
    say_written(told, path);
}

} // namespace

void check_certified_names(const std::string& certificate, const std::vector<std::string>& files) {
    for (const std::string& file : files)
        if (file != "-" && !detail::is_utf8(certified_name(file, certificate)))
            refuse("a certificate cannot name this file, as its path is not UTF-8", file);
}

void check_certified_surfaces(std::span<const std::string> names,
                              std::span<const std::string> files) {
    for (std::size_t s = 0; s < names.size(); ++s)
        if (!detail::is_utf8(names[s]))
            refuse(fmt::format("a certificate cannot state the name of surface {} of {}, as "
                               "it is not UTF-8",
                               s + 1, names.size()),
                   files[s]);
}

Inputs read_certified_inputs(const std::string& certificate, const FileOptions& options,
                             Session& session) {
    auto inputs = read_inputs(options, session);
    if (certificate.empty()) return inputs;
    std::vector<std::string> names;
    for (const Surface& surface : inputs.surfaces) names.push_back(surface.name);
    check_certified_surfaces(names, inputs.files);
    return inputs;
}

bool is_certifiable(Format format, unsigned order) {
    return order == 1 && holds_tetrahedra(format) && format <= Format::medit;
}

void add_certificate(CLI::App& command, std::string& certificate) {
    add_value(command, "--certificate", certificate, "FILE",
              "Write all that it takes to check the result (terrane verify)");
}

void add_proof(CLI::App& command, ProofOptions& options) {
    add_certificate(command, options.certificate);
    add_value(command, "--exact", options.exact, "FILE",
              "Write the exact coordinates, as fractions");
}

namespace {

/// Warns if doubles that were divided anew are not connected as the exact part. Surfaces that nearly
/// coincide can overlap themselves where rounding joins them.
void warn_of_images(const std::string& certificate, const fs::path& file,
                    const CertifiedResult& result) {
    if (stated_deviation(result) == result.rounded->report.deviation) return;
    const auto text = must(read_file(file));
    const auto parsed = must(parse_certificate(text, certificate));
    const auto found =
        verify_doubles(result.surfaces, parsed, {.max_deviation = parsed.rounded->deviation})
            .violations;
    const auto flaw = std::ranges::find(found, Rule::R37_images, &Violation::rule);
    if (flaw != found.end())
        warn(fmt::format("terrane verify refuses {}: {}", certificate, flaw->sentence));
}

} // namespace

void warn_of_refusal(const std::string& certificate, const fs::path& file,
                     const CertifiedResult& result) {
    if (result.rounded != nullptr && result.layered == nullptr)
        warn_of_images(certificate, file, result);
    const double deviation = stated_deviation(result);
    if (deviation == 0) return;
    const auto own = result.surfaces.first(result.surfaces.size() - result.boundary_count);
    std::vector<Surface> inputs(own.begin(), own.end());
    for (std::size_t s = 0; s < result.growth.size(); ++s)
        inputs[s].triangles.resize(result.growth[s].given);
    const double accepted = default_max_deviation(inputs);
    if (deviation <= accepted) return;
    warn(fmt::format("{} states a deviation of {}, and terrane verify accepts at most {} unless it "
                     "is given --max-deviation {}",
                     certificate, figure(deviation), figure(accepted, 3), deviation));
}

namespace {

/// Refuses outputs that terrane verify does not judge.
void check_certified_formats(const FileOptions& files) {
    for (const std::string& file : files.outputs) {
        const auto format = !files.output_format.empty() ? format_named(files.output_format)
                            : file == "-"                ? format_named(files.format)
                                                         : format_of(file);
        if (format == Format::vtk || (format && holds_outlines(*format)))
            refuse("a certificate cannot be about a file in this format, which terrane verify "
                   "does not judge",
                   file);
    }
}

} // namespace

void plan_proof(const ProofOptions& options, const FileOptions& files) {
    if (options.certificate == "-" || options.exact == "-")
        refuse("standard output is for the mesh: name a file", "-");
    if (!options.certificate.empty() && std::ranges::count(files.inputs, "-") > 0)
        refuse("a certificate is about files, not standard input", "--certificate");
    for (const auto& path : {options.certificate, options.exact})
        if (!path.empty()) check_folder(path);
    if (options.certificate.empty()) return;
    check_certified_formats(files);
    check_certified_names(options.certificate, files.inputs);
    check_certified_names(options.certificate, files.outputs);
}

std::vector<SourceFile> certified_inputs(const std::vector<std::string>& files,
                                         const Inputs& inputs) {
    std::vector<SourceFile> certified;
    for (std::size_t f = 0; f < files.size(); ++f)
        certified.push_back({files[f], inputs.surfaces_of_file[f]});
    return certified;
}

std::vector<ResultFile> certified_outputs(const std::vector<Output>& outputs, const Mesh& mesh,
                                          bool ascii) {
    std::vector<ResultFile> certified;
    for (const Output& output : outputs) {
        certified.push_back({output.path, certified_format(output.format, ascii)});
        if (output.path != "-") continue;
        auto contents = must(format_mesh(mesh, output.format, {.ascii = ascii}));
        certified.back().contents = std::move(contents);
    }
    return certified;
}

void write_certificate(const std::string& path, const CertifiedResult& result, std::FILE* told,
                       Session& session) {
    session.begin("certificate", Phase::computing);
    write(path, must(certify(result, path, session.run())), told, session);
    warn_of_refusal(path, path, result);
}

void write_exact(const ProofOptions& options, const Arrangement& exact, std::FILE* told,
                 Session& session) {
    if (options.exact.empty()) return;
    session.begin("write", Phase::computing);
    write(options.exact, to_text(to_exact(exact, session.run())), told, session);
}

} // namespace terrane::cli
