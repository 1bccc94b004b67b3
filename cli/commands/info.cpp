// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/info_report.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/reading.hpp>

namespace terrane::cli {
namespace {

struct InfoCommand {
    FileOptions files;
    bool json = false;
};

constexpr auto info_footer =
    R"(For each file: its format, as its contents show it; for each surface its role, triangles, distinct
vertices, connected parts, border and flaws, exactly; the extent, and what the file states about coordinates; the names
and units of values on points and triangles. Warnings are those of all commands.

Examples:
  terrane info horizons.ts faults.ts
  terrane info export.dat --json > info.json)";

ExitStatus describe_files(const InfoCommand& command, Session& session) {
    plan_outputs(command.files, OutputKind::surfaces);
    const auto inputs = read_inputs(command.files, session);
    session.begin("check", Phase::computing);
    std::vector<FileInfo> files;
    std::size_t first = 0;
    for (std::size_t f = 0; f < command.files.inputs.size(); ++f) {
        const std::string& path = command.files.inputs[f];
        FileInfo& info = files.emplace_back();
        info.file = path == "-" ? "standard input" : path;
        info.format = format_in(path, format_of_input(command.files, path));
        for (const std::size_t end = first + inputs.surfaces_of_file[f]; first < end; ++first)
            info.surfaces.push_back(
                must(check(std::span(inputs.surfaces).subspan(first, 1), session.run())));
    }
    const CheckReport together = must(check(inputs.surfaces, session.run()));
    session.end_stage();
    Json found;
    examine(inputs.surfaces, {}, inputs, session, found);
    if (command.json) {
        Json json = json_of(files, together, inputs);
        json["warnings"] = found["warnings"];
        print(stdout, text_of(json));
    } else {
        say(stdout, text_of(files, together, inputs));
    }
    return ExitStatus::done;
}

} // namespace

Command info_command(CLI::App& program) {
    auto options = std::make_shared<InfoCommand>();
    auto* app = program.add_subcommand("info", "Say what files contain");
    add_inputs(*app, options->files);
    app->add_flag("--json", options->json, "As JSON");
    add_threads(*app, options->files);
    app->footer(info_footer);
    return {app, [options] {
                Session session(options->files.threads);
                return describe_files(*options, session);
            }};
}

} // namespace terrane::cli
