// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

struct MapCommand {
    FileOptions files;
    std::string kind;
    std::vector<std::string> to; ///< files of the other surface
    double step = 0;             ///< of the grid; 0: that of `like`
    std::string like;            ///< file of a grid; empty: none
};

constexpr auto map_footer =
    R"(NUMBER is one of
  height     z of the surface
  depth      -z
  dip        angle between the surface and the horizontal, in degrees
  azimuth    direction in which it dips, in degrees clockwise from y
  thickness  height above the surface of --to, along the vertical
  distance   to the nearest point of the surface of --to, in space: true thickness

All files of IN are one surface, those of --to another. Which triangle is above or below a node is
decided exactly. Where the vertical through a node meets a surface more than once, its highest point
counts, and a warning says how often. Nodes off the surface have no value. The nodes are at multiples of
--step, or those of the grid --like.

Examples:
  terrane map depth top.ts --step 50 -o depth.asc
  terrane map thickness top.ts --to base.ts --like top.irap -o thickness.irap
  terrane map distance horizon.ts --to F1.ts --to F2.ts --step 25 -o distance.vti)";

/// The smallest, the largest and the mean value of a grid.
struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -low, mean = 0;
};

Range range_of(const SurfaceMap& map) {
    Range range;
    for (const double value : map.grid.values) {
        if (std::isnan(value)) continue;
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
        range.mean += value / double(map.nodes);
    }
    return range;
}

std::string map_text(const SurfaceMap& map, MapKind kind, const Quantities& quantities) {
    const bool is_angle = kind == MapKind::dip || kind == MapKind::azimuth;
    const auto text_of_value = [&](double value) {
        constexpr int digits = 6;
        return is_angle ? fmt::format("{} degrees", figure(value, digits))
                        : quantities.length(value, digits);
    };
    const Grid& grid = map.grid;
    std::string text = fmt::format(
        "{}: {} x {} nodes, steps of {}, {} with a value", name_of(kind), grid.nx, grid.ny,
        std::fabs(grid.dx) == std::fabs(grid.dy) ? quantities.length(std::fabs(grid.dx))
                                                 : quantities.length(std::fabs(grid.dx)) + " and " +
                                                       quantities.length(std::fabs(grid.dy)),
        map.nodes);
    if (map.nodes > 0) {
        const Range range = range_of(map);
        text += fmt::format(": {} to {}", text_of_value(range.low), text_of_value(range.high));
        if (kind != MapKind::azimuth) text += ", mean " + text_of_value(range.mean);
    }
    return text + "\n";
}

Grid nodes_of(const MapCommand& command, std::span<const Surface> surfaces, const std::string& name,
              const CLI::App& app) {
    Result<Grid> nodes =
        command.like.empty() ? grid_over(surfaces, command.step) : read_grid(command.like);
    if (!nodes) throw Failure{at_option(nodes.error(), app)};
    nodes->name = name;
    return std::move(*nodes);
}

ExitStatus map_files(const MapCommand& command, const CLI::App& app, Session& session) {
    const FileOptions& files = command.files;
    const auto outputs = plan_outputs(files, OutputKind::grids);
    const MapKind kind = *map_kind_named(command.kind);
    if ((command.step > 0) != command.like.empty())
        refuse("give either --step or --like, for the nodes of the map", "--step");
    FileOptions all = files; // read together, so that warnings are about them together
    all.inputs.insert(all.inputs.end(), command.to.begin(), command.to.end());
    check_streams(all);
    const auto inputs = read_inputs(all, session);
    std::size_t mapped = 0; // surfaces
    for (std::size_t f = 0; f < files.inputs.size(); ++f) mapped += inputs.surfaces_of_file[f];
    const auto surfaces = std::span(inputs.surfaces).first(mapped);
    const auto to = std::span(inputs.surfaces).subspan(mapped);
    Json statistics = statistics_of(inputs);
    auto doubts = find_doubts(inputs.surfaces);
    std::erase_if(doubts, [](const PlausibilityWarning& w) { // a map makes no blocks
        return w.doubt == Doubt::duplicate_surface;
    });
    add_constants(statistics, "plausibility", plausibility_constants());
    report_doubts(doubts, inputs.labels, inputs.strict, statistics);
    const auto map = session.timed("map", [&] {
        return map_surface(surfaces, kind, nodes_of(command, surfaces, inputs.labels.front(), app),
                           to, session.run());
    });
    if (!map) throw Failure{at_option(map.error(), app)};
    std::FILE* const told = summary_stream(files);
    say(told, map_text(*map, kind, inputs.quantities()));
    if (map->sheets > 0)
        warn(fmt::format(
            "at {} the vertical meets the surface more than once: the highest point counts",
            counted(map->sheets, "node")));
    if (map->nodes == 0) {
        print(stderr, complaint("no node has a value: nothing written"));
    } else {
        for (const Output& output : outputs) {
            write_output(map->grid, output, session);
            tell_when_written(told, wrote(output));
        }
        const Range range = range_of(*map);
        statistics["map"] = {{"number", command.kind}, {"nodes", map->nodes},
                             {"sheets", map->sheets},  {"least", range.low},
                             {"greatest", range.high}, {"mean", range.mean}};
    }
    write_statistics(std::move(statistics), files.stats, session);
    return map->nodes > 0 ? ExitStatus::done : ExitStatus::negative;
}

} // namespace

Command map_command(CLI::App& program) {
    auto command = std::make_shared<MapCommand>();
    auto* app = program.add_subcommand("map", "Map depth, dip, thickness or distance on a grid");
    add_value(*app, "NUMBER", command->kind, "NUMBER", "What is mapped: depth, thickness, ...")
        ->required()
        ->check(one_of({"height", "depth", "dip", "azimuth", "thickness", "distance"}));
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the grid: .asc, .zmap, .irap, .grd or .vti");
    add_value(*app, "--to", command->to, "FILE",
              "File with the other surface, for thickness and distance")
        ->allow_extra_args(false);
    add_value(*app, "--step", command->step, "LENGTH", "Distance of the nodes")->check(positive());
    add_value(*app, "--like", command->like, "FILE", "File with a grid that has the nodes");
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(map_footer);
    return {app, [app, command] {
                Session session(command->files.threads);
                return map_files(*command, *app, session);
            }};
}

} // namespace terrane::cli
