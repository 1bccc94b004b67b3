// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/judge.hpp>

#include <limits>
#include <memory>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/judge_report.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/judgement/limits.hpp>

namespace terrane::cli {
namespace {

struct JudgeCommand {
    FileOptions inputs;
    std::string output, operation;
    double spacings = JudgeOptions().spacings;
    JudgementLimits limits;
    bool soup = false, json = false, tags = false, all = false;
};

constexpr auto judge_footer =
    R"(Properties of a mesh, which any program may have made: conforming, distinct, welded, vertices,
curves, coverage, topology, orientation; with --operation volume, too. It is compared with the exact
arrangement of the inputs, or with the boundary of the operation; each input file is one operand.
Tetrahedra (VTU, MSH, legacy VTK) are compared with the blocks between the inputs: positive, conforming, welded,
vertices, curves, coverage, topology, labels, volume.
--soup judges triangles alone: conforming, distinct, welded, closed, manifold, oriented, tetgen.
docs/how-to/judge.md says what each property means.

Exit status: 0 all properties hold; 1 one fails; 2 one cannot be judged, a file cannot be read, or an
operand bounds no solid; 3 a limit of time or memory was reached, or internal.

Examples:
  terrane judge model.obj horizons.ts faults.ts
  terrane judge union.off a.off b.off --operation union --json
  terrane judge --soup facets.stl)";

/// Returns the operand of each surface: the number of its file.
std::vector<std::uint32_t> operands_of(const Inputs& inputs) {
    std::vector<std::uint32_t> operands;
    for (std::uint32_t file = 0; file < inputs.surfaces_of_file.size(); ++file)
        operands.insert(operands.end(), inputs.surfaces_of_file[file], file);
    return operands;
}

JudgeOptions options_of(const JudgeCommand& command, const Inputs& inputs) {
    JudgeOptions options;
    options.spacings = command.spacings;
    if (command.all) options.most_flaws = std::numeric_limits<std::size_t>::max();
    options.operation = operation_named(command.operation);
    if (options.operation) options.operand_of = operands_of(inputs);
    return options;
}

void check_usage(const JudgeCommand& command) {
    plan_outputs(command.inputs, OutputKind::surfaces); // refuses unknown formats
    const bool alone = command.inputs.inputs.empty();
    if (command.soup && !alone) refuse(ErrorCode::bad_option, "judges one file alone", "--soup");
    if (command.soup && !command.operation.empty())
        refuse(ErrorCode::bad_option, "is for meshes with inputs, not for --soup", "--operation");
    if (!command.soup && alone)
        refuse(ErrorCode::bad_option, "needs the input files, or --soup", "judge");
}

/// Returns what is said of an error that kept a mesh from being judged.
ExitStatus not_judged(const Error& error, bool tags) {
    const bool late = error.code == ErrorCode::timed_out;
    if (tags) print(stdout, tag_line(late ? "TIMEOUT" : "INPUT_IS_INVALID"));
    Error named = error;
    if (late) named.place = "--time";
    if (error.place.empty() && error.code == ErrorCode::out_of_memory) named.place = "--memory";
    const ExitStatus status = fail(named);
    if (late) return ExitStatus::internal;
    return error.code == ErrorCode::not_closed ? ExitStatus::bad_input : status;
}

/// Returns the mesh that is judged. With inputs, a file without triangles is an empty mesh, as the intersection of
/// solids that are apart is.
Inputs read_output(const JudgeCommand& command, const FileOptions& files, Session& session) {
    try {
        return read_inputs(files, session);
    } catch (const Failure& failure) {
        if (command.soup || failure.error.code != ErrorCode::nothing_to_do) throw;
        return {};
    }
}

/// Returns the tetrahedra of a file that is judged by inputs, if it has any.
std::optional<LabelledTetrahedra> tetrahedra_in(const JudgeCommand& command) {
    if (command.soup || command.output == "-" || !command.operation.empty()) return std::nullopt;
    auto found = read_tetrahedra(command.output);
    if (!found && found.error().code == ErrorCode::nothing_to_do) return std::nullopt;
    return must(std::move(found));
}

/// Begins the page, if it is wanted; it is about the mesh and its inputs.
page::Page plan_report(const JudgeCommand& command, const Session& session) {
    FileOptions files = command.inputs;
    files.inputs.insert(files.inputs.begin(), command.output);
    page::Page page = plan_page(files, session);
    if (page.wanted())
        for (const std::string& path : files.inputs) must(page.add_file(path));
    return page;
}

ExitStatus judge_file(const JudgeCommand& command) {
    check_usage(command);
    Session session(1); // processor time is that of one thread
    FileOptions of_output;
    of_output.inputs = {command.output};
    page::Page page = plan_report(command, session);
    const auto tetrahedra = tetrahedra_in(command);
    Inputs output = tetrahedra ? Inputs() : read_output(command, of_output, session);
    const Inputs inputs = command.soup ? Inputs() : read_inputs(command.inputs, session);
    if (tetrahedra) output.extent = inputs.extent;
    const JudgeOptions options = options_of(command, inputs);
    session.begin("judge", Phase::computing);
    const auto judged =
        judge_within(command.limits, session.run().stop, [&](const std::stop_token& stop) {
            Run run = session.run();
            run.stop = stop;
            return tetrahedra     ? judge(*tetrahedra, inputs.surfaces, options, run)
                   : command.soup ? judge_soup(output.surfaces, options, run)
                                  : judge(output.surfaces, inputs.surfaces, options, run);
        });
    session.end_stage();
    if (!judged) return not_judged(judged.error(), command.tags);
    const JudgedMesh mesh{output, name_of_inputs(of_output),
                          tetrahedra ? tetrahedra->tetrahedra.size() : 0};
    if (command.json) print(stdout, judge_json(*judged, mesh));
    if (command.tags) print(stdout, tag_line(tag_of(*judged)));
    if (!command.json && !command.tags) say(stdout, judge_text(*judged, mesh));
    if (page.wanted()) {
        page.set_inputs(output.unit, tetrahedra ? inputs.files : output.files);
        must(page.add_judged(tetrahedra ? inputs.surfaces : output.surfaces, *judged));
        write_page(page, command.inputs, judge_statistics(*judged), session);
    }
    if (!judged->holds()) return ExitStatus::negative;
    if (judged->complete()) return ExitStatus::done;
    must(FileSet::current()->publish()); // the page, though the status is that of a failure
    return ExitStatus::bad_input;
}

} // namespace

Command judge_command(CLI::App& program) {
    auto options = std::make_shared<JudgeCommand>();
    auto* app = program.add_subcommand("judge", "Judge any mesh by its input files, exactly");
    add_value(*app, "MESH", options->output, "FILE", "The mesh that is judged")->required();
    add_value(*app, "IN", options->inputs.inputs, "FILE", "The input files that it was made from");
    add_reading(*app, options->inputs);
    app->add_flag("--soup", options->soup, "Judge the triangles of MESH alone, without inputs");
    add_value(*app, "--operation", options->operation, "NAME",
              "What the mesh is of the solids in the input files, one per file")
        ->check(one_of({"union", "intersection", "difference", "symmetric-difference"}));
    add_value(*app, "--spacings", options->spacings, "N",
              "How far points may be rounded, in spacings of doubles at the largest coordinate of "
              "the inputs; 16 unless given")
        ->check(CLI::NonNegativeNumber.description(""));
    add_value(*app, "--time", options->limits.time, "S",
              "Processor time that it may take, in seconds; 3600 unless given")
        ->check(positive());
    add_value(*app, "--memory", options->limits.memory, "BYTES",
              "Memory that it may take; 16e9 unless given")
        ->check(positive());
    app->add_flag("--all", options->all, "List all flaws, not only the first 10 of each property");
    app->add_flag("--json", options->json, "One line of JSON per property");
    app->add_flag("--tags", options->tags,
                  "One line with a tag, as CGAL's robustness benchmarks have it");
    add_report(*app, options->inputs);
    app->footer(judge_footer);
    return {app, [options] { return judge_file(*options); }};
}

} // namespace terrane::cli
