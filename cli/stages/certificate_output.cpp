// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/certificate_output.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/exact_text.hpp>
#include <terrane/io/text/utf8.hpp>

namespace terrane::cli {

namespace {

Status write(const std::string& path, const std::string& text, std::FILE* told, Session& session) {
    session.begin("write", Phase::writing);
    auto status = write_file(path, text);
    session.end_stage();
    if (status) say_written(told, path);
    return status;
}

} // namespace

Status check_certified_names(const std::string& certificate,
                             const std::vector<std::string>& files) {
    for (const std::string& file : files)
        if (file != "-" && !detail::is_utf8(certified_name(file, certificate)))
            return Error{ErrorCode::bad_option,
                         "a certificate cannot name this file, as its path is not UTF-8", file};
    return Done{};
}

Status check_certified_surfaces(std::span<const std::string> names,
                                std::span<const std::string> files) {
    for (std::size_t s = 0; s < names.size(); ++s)
        if (!detail::is_utf8(names[s]))
            return Error{ErrorCode::bad_option,
                         fmt::format("a certificate cannot state the name of surface {} of {}, as "
                                     "it is not UTF-8",
                                     s + 1, names.size()),
                         files[s]};
    return Done{};
}

Result<Inputs> read_certified_inputs(const std::string& certificate, const FileOptions& options,
                                     Session& session) {
    auto inputs = read_inputs(options, session);
    if (!inputs || certificate.empty()) return inputs;
    std::vector<std::string> names;
    for (const Surface& surface : inputs->surfaces) names.push_back(surface.name);
    if (const auto sound = check_certified_surfaces(names, inputs->files); !sound)
        return sound.error();
    return inputs;
}

bool is_certifiable(Format format, unsigned order) {
    return order == 1 && holds_tetrahedra(format) && format <= Format::medit;
}

void add_certificate(CLI::App& command, std::string& certificate) {
    command
        .add_option("--certificate", certificate,
                    "Write all that it takes to check the result (terrane verify)")
        ->type_name("FILE");
}

void add_proof(CLI::App& command, ProofOptions& options) {
    add_certificate(command, options.certificate);
    command.add_option("--exact", options.exact, "Write the exact coordinates, as fractions")
        ->type_name("FILE");
}

void warn_of_deviation(const std::string& certificate, double deviation,
                       std::span<const Surface> inputs) {
    const double accepted = default_max_deviation(inputs);
    if (!(deviation > accepted)) return;
    warn(fmt::format("{} states a deviation of {}, and terrane verify accepts at most {} unless it "
                     "is given --max-deviation {}",
                     certificate, figure(deviation), figure(accepted, 3), deviation));
}

namespace {

/// Refuses outputs that terrane verify does not read.
Status check_certified_formats(const FileOptions& files) {
    for (const std::string& file : files.outputs) {
        const auto format = !files.output_format.empty() ? format_named(files.output_format)
                            : file == "-"                ? format_named(files.format)
                                                         : format_of(file);
        if (format == Format::vtk || (format && holds_outlines(*format)))
            return Error{
                ErrorCode::bad_option,
                "a certificate cannot be about a file in this format, which terrane verify "
                "does not read",
                file};
    }
    return Done{};
}

} // namespace

Status plan_proof(const ProofOptions& options, const FileOptions& files) {
    if (options.certificate == "-" || options.exact == "-")
        return Error{ErrorCode::bad_option, "standard output is for the mesh: name a file", "-"};
    if (!options.certificate.empty() && std::ranges::count(files.inputs, "-") > 0)
        return Error{ErrorCode::bad_option, "a certificate is about files, not standard input",
                     "--certificate"};
    for (const auto& path : {options.certificate, options.exact})
        if (!path.empty())
            if (auto status = check_folder(path); !status) return status;
    if (options.certificate.empty()) return Done{};
    if (auto status = check_certified_formats(files); !status) return status;
    if (auto status = check_certified_names(options.certificate, files.inputs); !status)
        return status;
    return check_certified_names(options.certificate, files.outputs);
}

std::vector<SourceFile> certified_inputs(const std::vector<std::string>& files,
                                         const Inputs& inputs) {
    std::vector<SourceFile> certified;
    for (std::size_t f = 0; f < files.size(); ++f)
        certified.push_back({files[f], inputs.surfaces_of_file[f]});
    return certified;
}

Result<std::vector<ResultFile>> certified_outputs(const std::vector<Output>& outputs,
                                                  const Mesh& mesh, bool ascii) {
    std::vector<ResultFile> certified;
    for (const Output& output : outputs) {
        certified.push_back({output.path, certified_format(output.format, ascii)});
        if (output.path != "-") continue;
        auto contents = format_mesh(mesh, output.format, {.ascii = ascii});
        if (!contents) return contents.error();
        certified.back().contents = *std::move(contents);
    }
    return certified;
}

Status write_certificate(const std::string& path, const CertifiedResult& result, std::FILE* told,
                         Session& session) {
    session.begin("certificate", Phase::computing);
    const auto text = certify(result, path, session.run());
    if (!text) return text.error();
    auto status = write(path, *text, told, session);
    if (status) warn_of_deviation(path, stated_deviation(result), result.surfaces);
    return status;
}

Status write_exact(const ProofOptions& options, const Arrangement& exact, std::FILE* told,
                   Session& session) {
    if (options.exact.empty()) return Done{};
    session.begin("write", Phase::computing);
    return write(options.exact, to_text(to_exact(exact, session.run())), told, session);
}

} // namespace terrane::cli
