// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The command reads the input files again with the readers of io/; terrane::verify alone judges.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/verify/verify_certificate.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_violations = 50; ///< named on the terminal

struct VerifyCommand {
    std::string certificate;
    FileOptions files; ///< inputs and how they are read
    bool json = false;
};

constexpr auto verify_footer =
    R"(A certificate says how a mesh follows from its input files. It is judged with rational
arithmetic, by code that shares nothing with what made it. IN are the input files in the order of
the certificate; without IN they are looked for beside it, under the names that it gives. What
changed how they were read (--depth, --max-edge, --input-format) must be given here, too.

Exit status: 0 valid, 1 refuted (which rule, which elements), 2 cannot read, 3 internal.

Examples:
  terrane arrange horizons.ts faults.ts -o model.vtp --certificate model.json
  terrane verify model.json
  terrane verify model.json data/horizons.ts data/faults.ts)";

std::vector<std::string> paths_of(const VerifyCommand& command, const Certificate& certificate) {
    if (!command.files.inputs.empty()) return command.files.inputs;
    const fs::path folder =
        command.certificate == "-" ? fs::path() : fs::path(command.certificate).parent_path();
    std::vector<std::string> paths;
    for (const CertifiedInput& input : certificate.inputs)
        paths.push_back((folder / input.name).string());
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

Result<std::vector<InputFile>> read_inputs(const VerifyCommand& command,
                                           const Certificate& certificate) {
    const auto paths = paths_of(command, certificate);
    if (paths.size() != certificate.inputs.size())
        return Error{ErrorCode::bad_option,
                     fmt::format("the certificate is about {}, not {}",
                                 counted(certificate.inputs.size(), "file"), paths.size()),
                     command.certificate};
    std::vector<InputFile> files;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        auto file = read_input(paths[i], certificate.inputs[i], command.files);
        if (!file) return file.error();
        files.push_back(std::move(file.value()));
    }
    return files;
}

std::string verdict_text(const Certificate& certificate, const std::string& name,
                         const std::vector<Violation>& violations) {
    if (violations.empty()) {
        const auto& rounded = certificate.rounded;
        return fmt::format(
            "{}: valid: {} exact triangles; {}\n{}\n", name, certificate.exact.triangles.size(),
            !rounded         ? std::string("no doubles")
            : rounded->clean ? fmt::format("{} of doubles, conforming",
                                           counted(rounded->triangles.size(), "triangle"))
                             : std::string("doubles not conforming, as it says"),
            certificate.digest);
    }
    auto text = fmt::format("{}: refuted: {}\n", name, counted(violations.size(), "violation"));
    for (std::size_t i = 0; i < violations.size() && i < most_violations; ++i)
        text += fmt::format("  {}: {}\n", name_of(violations[i].rule), violations[i].sentence);
    if (violations.size() > most_violations)
        text += fmt::format("  and {} more\n", violations.size() - most_violations);
    return text;
}

std::string verdict_json(const Certificate& certificate, const std::vector<Violation>& violations) {
    Json json{{"valid", violations.empty()},
              {"digest", certificate.digest},
              {"violations", Json::array()}};
    for (const Violation& v : violations)
        json["violations"].push_back(
            {{"rule", name_of(v.rule)}, {"elements", v.elements}, {"sentence", v.sentence}});
    return text_of(json);
}

Result<ExitStatus> verify_file(const VerifyCommand& command) {
    const std::string name = command.certificate == "-" ? "standard input" : command.certificate;
    const auto text = read_file(command.certificate);
    if (!text) return text.error();
    const auto certificate = parse_certificate(text.value(), name);
    if (!certificate) return certificate.error();
    const auto files = read_inputs(command, certificate.value());
    if (!files) return files.error();
    const auto violations = verify_certificate(files.value(), certificate.value());
    print(stdout, command.json ? verdict_json(certificate.value(), violations)
                               : verdict_text(certificate.value(), name, violations));
    return violations.empty() ? ExitStatus::done : ExitStatus::negative;
}

} // namespace

Command verify_command(CLI::App& program) {
    auto options = std::make_shared<VerifyCommand>();
    auto* app = program.add_subcommand("verify", "Judge a certificate from its input files");
    app->add_option("CERT", options->certificate, "Certificate; - is standard input")
        ->required()
        ->type_name("CERT");
    app->add_option("IN", options->files.inputs, "The input files")->type_name("FILE");
    add_reading(*app, options->files);
    app->add_flag("--json", options->json, "The verdict as JSON");
    app->footer(verify_footer);
    return {app, [options] {
                const auto status = verify_file(*options);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
