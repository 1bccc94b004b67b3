// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <string>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/verdict_report.hpp>

namespace terrane::cli {
namespace {

struct VerifyCommand {
    JudgementRequest request;
    FileOptions files;
    std::string certificate;
    std::vector<std::string> outputs, expected;
    std::string folder;
    bool json = false;
};

constexpr auto verify_footer =
    R"(A certificate says how a mesh follows from its input files. It is judged with rational
arithmetic, by code that shares nothing with what made it. IN are the input files in the order of
the certificate; without IN they are looked for under the names that it gives. Each is read in the
format of its own name. What changed how they were read (--depth, --max-edge, --columns, --input-format) must be
given here, too.

The verifier makes the output files that the certificate names anew and compares them byte for byte;
formats that it does not write are bound by their SHA-256 only. Name a file that was moved with
--output.

A certificate may come from anybody: of the files that it names, only those in its folder, or in that
of --folder, are opened. Only files of the stated size are read.

The verifier computes how far the mesh is from the inputs. It accepts at most 2^-40 of their largest
coordinate, some thousand spacings of the doubles. Where surfaces were changed, it accepts limits up
to a twentieth of the diagonal of the box around the inputs.

Exit status: 0 all is verified; 1 refuted (which rule, which elements); 2 a file cannot be read, or
nothing is verified about an output file; 3 a limit of time or memory was reached, or internal.

Examples:
  terrane arrange horizons.ts faults.ts -o model.vtp --certificate model.json
  terrane verify model.json
  terrane verify model.json data/horizons.ts data/faults.ts
  terrane verify model.json --output sent/model.vtp)";

/// Returns the error with the option that sets the limit which was reached.
Error at_limit(Error error) {
    if (error.place.empty() && error.code == ErrorCode::timed_out) error.place = "--time";
    if (error.place.empty() && error.code == ErrorCode::out_of_memory) error.place = "--memory";
    return error;
}

ExitStatus verify_file(VerifyCommand command) {
    const FileOptions& files = command.files;
    JudgementRequest& request = command.request;
    if (!files.input_format.empty() && !format_named(files.input_format))
        refuse(ErrorCode::unknown_format, "unknown format " + files.input_format, "");
    request.certificate = command.certificate;
    request.inputs.assign(files.inputs.begin(), files.inputs.end());
    request.expected.assign(command.expected.begin(), command.expected.end());
    request.outputs.assign(command.outputs.begin(), command.outputs.end());
    request.folder = command.folder;
    request.reading = {format_named(files.input_format),
                       files.read,
                       command.certificate.c_str(),
                       {"--depth", "--max-edge", "--columns"}};
    Session session(1); // of which only the interrupts and the progress line are wanted
    session.begin("verify", Phase::idle);
    const auto found = judge(request, session.run().stop);
    session.end_stage();
    if (!found) {
        const ExitStatus status = fail(at_limit(found.error()));
        return found.error().code == ErrorCode::timed_out ? ExitStatus::internal : status;
    }
    const Judgement& judged = *found;
    const std::string& path = command.certificate;
    if (command.json)
        print(stdout, verdict_json(judged));
    else
        say(stdout, verdict_text(judged, path == "-" ? "standard input" : one_line(path)));
    return judged.verified()             ? ExitStatus::done
           : judged.violations().empty() ? ExitStatus::bad_input
                                         : ExitStatus::negative;
}

} // namespace

Command verify_command(CLI::App& program) {
    auto options = std::make_shared<VerifyCommand>();
    auto* app = program.add_subcommand("verify", "Judge a certificate from its input files");
    add_value(*app, "CERT", options->certificate, "CERT", "Certificate; - is standard input")
        ->required();
    add_value(*app, "IN", options->files.inputs, "FILE", "The input files");
    add_reading(*app, options->files);
    add_value(*app, "--expect-input", options->expected, "FILE",
              "A file that must be among the inputs, wherever those are read; may be repeated");
    add_value(*app, "--output", options->outputs, "FILE",
              "An output file that is not where the certificate says; may be repeated");
    add_value(*app, "--folder", options->folder, "DIR",
              "The folder that has the files which the certificate names; its own unless given");
    add_value(*app, "--max-deviation", options->request.options.max_deviation, "D",
              "The largest distance between the mesh and the inputs that is accepted")
        ->check(CLI::NonNegativeNumber.description(""));
    add_value(*app, "--max-change", options->request.options.max_change, "D",
              "The largest limit of a change to surfaces that is accepted, for instance of "
              "improved triangles")
        ->check(CLI::NonNegativeNumber.description(""));
    add_value(*app, "--time", options->request.limits.time, "S",
              "Processor time that it may take, in seconds; 3600 unless given")
        ->check(positive());
    add_value(*app, "--memory", options->request.limits.memory, "BYTES",
              "Memory that it may take; 16e9 unless given")
        ->check(positive());
    app->add_flag("--json", options->json, "The verdict as JSON");
    app->footer(verify_footer);
    return {app, [options] { return verify_file(*options); }};
}

} // namespace terrane::cli
