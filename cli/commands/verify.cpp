// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <string>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/verdict_report.hpp>
#include <terrane/cli/stages/judgement.hpp>

namespace terrane::cli {
namespace {

struct VerifyCommand {
    CertificateRequest request;
    bool json = false;
};

constexpr auto verify_footer =
    R"(A certificate says how a mesh follows from its input files. It is judged with rational
arithmetic, by code that shares nothing with what made it. IN are the input files in the order of
the certificate; without IN they are looked for in its folder, under the names that it gives. Their
formats are those of their own names. What changed how they were read (--depth, --max-edge,
--input-format) must be given here, too.

The verifier makes the output files that the certificate names anew and compares them byte for byte;
formats that it does not write are bound by their SHA-256 only. Name a file that was moved with
--output; the others are judged where the certificate says.

The verifier computes how far the mesh is from the inputs. It accepts at most 2^-20 of the diagonal
of the box around them or, if that is more, 2^-40 of their largest coordinate. Where surfaces were
changed, it accepts limits up to a twentieth of that diagonal.

Exit status: 0 all is verified; 1 refuted (which rule, which elements); 2 a file cannot be read, or
nothing is verified about an output file; 3 internal.

Examples:
  terrane arrange horizons.ts faults.ts -o model.vtp --certificate model.json
  terrane verify model.json
  terrane verify model.json data/horizons.ts data/faults.ts
  terrane verify model.json --output sent/model.vtp)";

ExitStatus verify_file(const VerifyCommand& command) {
    Session session(1); // of which only the interrupts and the progress line are wanted
    session.begin("verify", Phase::idle);
    const auto judged = judge_certificate(command.request);
    session.end_stage();
    const std::string& path = command.request.certificate;
    if (command.json)
        print(stdout, verdict_json(judged));
    else
        say(stdout, verdict_text(judged, path == "-" ? "standard input" : one_line(path)));
    return judged.status();
}

} // namespace

Command verify_command(CLI::App& program) {
    auto options = std::make_shared<VerifyCommand>();
    auto* app = program.add_subcommand("verify", "Judge a certificate from its input files");
    add_value(*app, "CERT", options->request.certificate, "CERT",
              "Certificate; - is standard input")
        ->required();
    add_value(*app, "IN", options->request.files.inputs, "FILE", "The input files");
    add_reading(*app, options->request.files);
    add_value(*app, "--output", options->request.outputs, "FILE",
              "An output file that is not where the certificate says; may be repeated");
    add_value(*app, "--max-deviation", options->request.options.max_deviation, "D",
              "The largest distance between the mesh and the inputs that is accepted")
        ->check(CLI::NonNegativeNumber.description(""));
    add_value(*app, "--max-change", options->request.options.max_change, "D",
              "The largest limit of a change to surfaces that is accepted, for instance of "
              "improved triangles")
        ->check(CLI::NonNegativeNumber.description(""));
    app->add_flag("--json", options->json, "The verdict as JSON");
    app->footer(verify_footer);
    return {app, [options] { return verify_file(*options); }};
}

} // namespace terrane::cli
