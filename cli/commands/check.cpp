// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/check.hpp>

#include <memory>

#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/reports/check_report.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

struct CheckCommand {
    FileOptions files;
    bool json = false, all = false;
};

constexpr auto check_footer =
    R"(Findings: pairs of triangles that meet other than in a shared vertex or edge, triangles without
area, triangles that repeat another of their surface. All of it is decided exactly. Free borders,
non-manifold edges and triangles in several surfaces are counted too, but are no findings.
Triangles are counted from 0 within their surface, in the order of the file. A vertex is a place:
equal coordinates are one vertex.

Exit status: 0 no findings, 1 findings, 2 cannot read, 3 internal.

Examples:
  terrane check model.obj
  terrane check horizons.ts faults.ts --json > findings.json)";

ExitStatus check_files(const CheckCommand& command, Session& session) {
    plan_outputs(command.files, OutputKind::surfaces);
    auto page = plan_page(command.files, session);
    const auto inputs = read_inputs(command.files, session);
    add_page_inputs(page, command.files, inputs);
    Json warnings;
    examine(inputs.surfaces, {}, inputs, session, warnings);
    session.begin("check", Phase::computing);
    const CheckReport r = must(check(inputs.surfaces, session.run()));
    session.end_stage();
    if (command.json)
        print(stdout, text_of(json_of(r, inputs)));
    else
        say(stdout, report_text(r, inputs, name_of_inputs(command.files), command.all));
    must(page.add_check(inputs.surfaces, r, session.run()));
    return write_run(page, json_of(r, inputs), command.files, session, r.clean());
}

} // namespace

Command check_command(CLI::App& program) {
    auto options = std::make_shared<CheckCommand>();
    auto* app = program.add_subcommand("check", "Find all flaws of triangles, exactly");
    add_inputs(*app, options->files);
    app->add_flag("--json", options->json, "All findings as JSON on standard output");
    app->add_flag("--all", options->all, "List all findings, not only the first of each kind");
    add_threads(*app, options->files);
    add_report(*app, options->files);
    app->footer(check_footer);
    return {app, [options] {
                Session session(options->files.threads);
                return check_files(*options, session);
            }};
}

} // namespace terrane::cli
