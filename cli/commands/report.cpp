// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/column.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/page/page.hpp>
#include <terrane/cli/stages/blocks.hpp>
#include <terrane/cli/stages/pipeline.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

struct ReportCommand {
    FileOptions files;
    ArrangeSettings settings;
    std::vector<std::string> roles; ///< NAME=ROLE
    std::string column;             ///< file; empty: none
};

constexpr auto report_footer =
    R"(Arranges the surfaces and finds the blocks as `terrane volume` does, and writes nothing but one
HTML file: the model to turn and to cut, its blocks and surfaces, what is wrong and where, plots and
tables. It opens in any browser, from disk, and asks no network for anything.

Where no conforming mesh of doubles was found, the page shows the contacts in the way, and the exit
status is 1. --report of the other commands writes the page of what they make.

Examples:
  terrane report horizons.ts faults.ts -o model.html
  terrane report model.ml -o model.html --box 0,0,-3000,10000,10000,500)";

Result<ExitStatus> report_files(const ReportCommand& command, Session& session) {
    Stopwatch total;
    const FileOptions& files = command.files;
    if (const auto planned = plan_outputs(files, OutputKind::surfaces); !planned)
        return planned.error();
    if (const auto sound = check_volume_options(command.settings.volume); !sound)
        return sound.error();
    auto page = Page::plan(files);
    if (!page) return page.error();
    auto inputs = read_inputs(files, session);
    if (!inputs) return inputs.error();
    if (const auto set = set_roles(command.roles, *inputs); !set) return set.error();
    const auto naming = naming_of(command.column, *inputs);
    if (!naming) return naming.error();
    if (const auto added = page->add_inputs(*inputs); !added) return added.error();
    if (const auto found = page->add_holes(*inputs, session.run()); !found) return found.error();
    Json statistics = statistics_of(*inputs, session.times());

    auto arranged = arrange_and_round(*inputs, command.settings, session, statistics);
    if (!arranged) return arranged.error();
    print(summary_stream(files), summary(*inputs, *arranged));
    page->add_arranged(*inputs, *arranged);
    const bool clean = arranged->rounded.report.clean;
    if (!clean) {
        print(stderr, offending_pairs(*inputs, *arranged));
    } else {
        const auto model = find_model(*arranged, *naming, session, statistics);
        if (!model) return model.error();
        const auto leaks = judge_leaks(*arranged, *model, session);
        if (!leaks) return leaks.error();
        print(summary_stream(files), model_text(*inputs, *model, *leaks));
        page->add_model(*inputs, *model, *leaks);
        if (const auto sound = examine(*model, *inputs, false, statistics); !sound)
            return sound.error();
    }
    return write_run(*page, statistics, files, total.lap(), clean);
}

} // namespace

Command report_command(CLI::App& program) {
    auto command = std::make_shared<ReportCommand>();
    auto* app =
        program.add_subcommand("report", "Show a model, and what is wrong with it, in a page");
    add_inputs(*app, command->files);
    command->files.app = app;
    app->add_option("-o,--output", command->files.report, "The page; - is standard output")
        ->required()
        ->type_name("FILE.html");
    add_roles(*app, command->roles);
    add_column(*app, command->column);
    add_settings(*app, command->settings);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(report_footer);
    return {app, [command] {
                Session session(command->files.threads);
                const auto status = report_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
