// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/grids/pillar_grid.hpp>

namespace terrane::cli {
namespace {

struct PillarCommand {
    FileOptions files;
    double step = 0;  ///< between pillars; 0: not given
    std::string x, y; ///< lines of pillars; empty: not given
    std::vector<unsigned> layers{1};
};

constexpr auto pillars_footer =
    R"(IN are horizons from the top down. Pillars are vertical, at multiples of --step in the map of the first horizon,
or where the lines of --x and --y cross. Each column of cells has nodes on each horizon at its four pillars; --layers
divides each unit between two horizons evenly.

A vertical fault that runs along lines of pillars splits its nodes: columns on both sides have different heights there.
No horizon may fold over. Cells are not active where a horizon is missing at a pillar of the column, where a horizon is
below the next one, and where they have no thickness. If none is active, nothing is written, and the exit status is 1.

OUT is .grdecl: SPECGRID, COORD, ZCORN, ACTNUM, and FIPNUM, which is the number of the unit from the top.

Examples:
  terrane pillars top.ts base.ts --step 100 --layers 10 -o reservoir.grdecl
  terrane pillars h1.ts h2.ts h3.ts --step 50 --layers 4,8 -o reservoir.grdecl)";

std::vector<double> lines_of(const std::string& text, const char* option) {
    auto numbers = numbers_in(text);
    if (!numbers) refuse("needs numbers with commas between", option);
    return std::move(*numbers);
}

PillarOptions options_of(const PillarCommand& command, const std::vector<Surface>& horizons) {
    const bool has_lines = !command.x.empty() && !command.y.empty();
    const bool has_some = !command.x.empty() || !command.y.empty();
    if (has_some != has_lines || has_lines == (command.step > 0))
        refuse("give either --step, or both --x and --y, for the pillars", "--step");
    PillarOptions options;
    options.layers = {command.layers.begin(), command.layers.end()};
    if (has_lines) {
        options.x = lines_of(command.x, "--x");
        options.y = lines_of(command.y, "--y");
        return options;
    }
    const auto grid =
        must(grid_over(std::span(horizons).first(std::min<std::size_t>(1, horizons.size())),
                       command.step),
             "--step");
    for (std::uint32_t i = 0; i < grid.nx; ++i) options.x.push_back(grid.x + i * grid.dx);
    for (std::uint32_t j = 0; j < grid.ny; ++j) options.y.push_back(grid.y + j * grid.dy);
    return options;
}

void check_pillar_outputs(const FileOptions& files) {
    FileOptions others = files; // the formats of inputs are checked with those of no output
    others.outputs.clear();
    others.output_format.clear();
    plan_outputs(others, OutputKind::surfaces);
    for (const std::string& path : files.outputs) {
        const auto extension = files.output_format.empty()
                                   ? std::filesystem::path(path).extension().string()
                                   : "." + files.output_format;
        if (extension != ".grdecl")
            refuse(ErrorCode::unknown_format, "corner-point grids are .grdecl", path);
        check_folder(path);
    }
    if (std::ranges::count(files.outputs, "-") > 1 ||
        (std::ranges::count(files.outputs, "-") == 1 && files.stats == "-"))
        refuse("standard output can take only one file");
}

void warn_of_gaps(const PillarGrid& made, const Inputs& inputs, bool is_crossed) {
    const auto of_kind = [&](const PillarGap& gap) { return gap.is_crossed == is_crossed; };
    const auto first = std::ranges::find_if(made.gaps, of_kind);
    if (first == made.gaps.end()) return;
    warn(fmt::format("{} of {}; the first is column {}, {}",
                     is_crossed ? "a horizon is below the next one at pillars"
                                : "a horizon is missing at pillars",
                     counted(std::ranges::count_if(made.gaps, of_kind), "column"), first->i + 1,
                     first->j + 1) +
         ", " + inputs.labels[first->horizon]);
}

ExitStatus make_pillar_files(const PillarCommand& command, Session& session) {
    const FileOptions& files = command.files;
    check_pillar_outputs(files);
    const auto inputs = read_inputs(files, session);
    Json statistics = statistics_of(inputs);
    examine(inputs.surfaces, {}, inputs, session, statistics);
    const PillarOptions options = options_of(command, inputs.surfaces);
    const auto made = session.timed(
        "pillars", [&] { return make_pillar_grid(inputs.surfaces, options, session.run()); });
    if (!made && made.error().code == ErrorCode::nothing_to_do) {
        print(stderr, complaint("nothing written: " + made.error().sentence));
        write_statistics(std::move(statistics), files.stats, session);
        return ExitStatus::negative;
    }
    if (!made) throw Failure{made.error()};
    for (const bool is_crossed : {false, true}) warn_of_gaps(*made, inputs, is_crossed);
    std::FILE* const told = summary_stream(files);
    const CornerPointGrid& grid = made->grid;
    say(told, fmt::format("pillars: {} x {} x {} cells, {} active\n", grid.nx, grid.ny, grid.nz,
                          made->active));
    for (const std::string& path : files.outputs) {
        session.begin("write", Phase::writing);
        must(write_file(path, to_grdecl(*made, inputs.surfaces)));
        session.end_stage();
        say_written(told, path);
    }
    statistics["pillars"] = {
        {"cells", grid.active.size()}, {"active", made->active}, {"gaps", made->gaps.size()}};
    write_statistics(std::move(statistics), files.stats, session);
    return ExitStatus::done;
}

} // namespace

Command pillars_command(CLI::App& program) {
    auto command = std::make_shared<PillarCommand>();
    auto* app = program.add_subcommand("pillars",
                                       "Make a corner-point grid of horizons on vertical pillars");
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the grid: .grdecl");
    add_value(*app, "--step", command->step, "LENGTH", "Distance of the pillars along x and y")
        ->check(CLI::PositiveNumber.description(""));
    add_value(*app, "--x", command->x, "X,X,...", "Lines of pillars across x, ascending");
    add_value(*app, "--y", command->y, "Y,Y,...", "Lines of pillars across y, ascending");
    add_value(*app, "--layers", command->layers, "N,...",
              "Number of layers in each unit; one number: in all (default: 1)")
        ->delimiter(',')
        ->allow_extra_args(false);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(pillars_footer);
    return {app, [command] {
                Session session(command->files.threads);
                return make_pillar_files(*command, session);
            }};
}

} // namespace terrane::cli
