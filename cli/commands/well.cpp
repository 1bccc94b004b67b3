// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/points/well_paths.hpp>
#include <terrane/io/sections/well_text.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_intervals = 40; ///< printed

struct WellCommand {
    ModelCommand model;
    std::vector<std::string> paths; ///< files
    std::vector<std::string> heads; ///< [WELL=]X,Y,Z
    double step = 0;                ///< of LAS; 0: depths at which the block changes
};

constexpr auto well_footer =
    R"(The surfaces are arranged, cut by a volume of interest and rounded as `terrane volume` does, and its options and
names of blocks are the same. Each path is a polyline, and is compared with the model exactly: where it enters and
leaves blocks, and where it meets surfaces. A part of a path that runs in a surface is stated as such, with all blocks
around it.

FILE of --path is a table whose heading names x, y and z, and perhaps well and md; or one that names md, inclination and
azimuth, for which --head says where the well begins; or LAS 2.0 with such curves. Between the stations of a survey
the well is an arc (minimum curvature), and the path the polyline through the stations. z points upwards.

OUT is a table of all wells (.csv), or LAS 2.0 (.las): one file for each well, with the numbers of blocks and units, and
their names as parameters.

Where no well meets the model nothing is written, and the exit status is 1.

Examples:
  terrane well *.ts --box 0,0,-3000,9000,9000,500 --path wells.csv -o log.csv
  terrane well model.ml --path A-1.csv --head 4500,4200,35 -o A-1.las)";

std::string contents_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) refuse(ErrorCode::cannot_open, "can't be opened: " + path, "--path");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<WellHead> heads_of(const WellCommand& command) {
    std::vector<WellHead> heads;
    for (const std::string& text : command.heads) {
        const std::size_t equals = text.rfind('=');
        const bool is_named = equals != std::string::npos;
        const auto n = numbers_in(is_named ? text.substr(equals + 1) : text);
        if (!n || n->size() != 3) refuse("needs X,Y,Z or WELL=X,Y,Z, not " + text, "--head");
        heads.push_back({is_named ? text.substr(0, equals) : "", {(*n)[0], (*n)[1], (*n)[2]}});
    }
    return heads;
}

/// Reads the paths, before any work is done.
std::vector<WellPaths> read_paths(const WellCommand& command) {
    const auto heads = heads_of(command);
    std::vector<WellPaths> files;
    std::set<std::string> names;
    for (const std::string& path : command.paths) {
        auto read = read_well_paths(contents_of(path), path,
                                    std::filesystem::path(path).stem().string(), heads);
        if (!read && read.error().code == ErrorCode::bad_option &&
            read.error().sentence.ends_with("not stated"))
            refuse(read.error().message(), "--head");
        files.push_back(must(std::move(read)));
        for (const WellPath& well : files.back().paths)
            if (!names.insert(well.name).second) refuse("has two wells: " + well.name, "--path");
    }
    for (const WellHead& head : heads)
        if (!head.well.empty() && !names.contains(head.well))
            refuse("there is no well " + head.well, "--head");
    return files;
}

/// Returns the format of an output. Errors: unknown_format.
WellFormat format_of_log(const FileOptions& files, const std::string& path) {
    const auto extension = files.output_format.empty()
                               ? std::filesystem::path(path).extension().string()
                               : "." + files.output_format;
    if (const auto format = well_format(extension)) return *format;
    refuse(ErrorCode::unknown_format, "logs of wells are .csv or .las", path);
}

/// Refuses outputs that would replace a file with paths.
void check_names(const WellCommand& command, std::span<const WellPaths> files) {
    std::vector<std::string> wells;
    for (const WellPaths& file : files)
        for (const WellPath& well : file.paths) wells.push_back(well.name);
    for (const std::string& output : command.model.files.outputs) {
        if (output == "-") continue;
        for (const auto& path :
             well_files(wells, format_of_log(command.model.files, output), output))
            for (const std::string& input : command.paths) {
                std::error_code none;
                if (std::filesystem::equivalent(path, input, none))
                    refuse("would replace " + input + ", which is read", "--output");
            }
    }
}

/// Refuses wells whose unit is known to be another one than that of the model.
std::vector<WellPath> paths_of(std::vector<WellPaths> files, const std::string& unit) {
    std::vector<WellPath> paths;
    for (WellPaths& file : files) {
        if (!file.unit.empty() && !unit.empty() && file.unit != unit)
            refuse(fmt::format("lengths of well {} are in {}, those of the model in {}",
                               file.paths[0].name, file.unit, unit),
                   "--path");
        std::ranges::move(file.paths, std::back_inserter(paths));
    }
    return paths;
}

bool meets_model(const WellLog& log) {
    return !log.markers.empty() || std::ranges::any_of(log.intervals, [](const WellInterval& in) {
        return in.blocks.back() != 0;
    });
}

std::string text_of(std::span<const WellLog> logs, const SectionNames& names,
                    const Quantities& quantities) {
    std::string text;
    std::size_t intervals = 0;
    for (const WellLog& log : logs) {
        const double length = log.intervals.back().to - log.intervals.front().from;
        text += fmt::format("well {}: {}, {}, {}\n", log.name, quantities.length(length),
                            counted(log.intervals.size(), "interval"),
                            counted(log.markers.size(), "marker"));
        for (const WellInterval& in : log.intervals) {
            if (++intervals > most_intervals) continue;
            constexpr int digits = 6;
            text += fmt::format("  {}  {}{}\n", quantities.lengths(in.from, in.to, digits),
                                in.surfaces.empty() ? "" : surfaces_text(in, names) + ", between ",
                                blocks_text(in, names));
        }
    }
    if (intervals > most_intervals)
        text += fmt::format("  and {} more\n", counted(intervals - most_intervals, "interval"));
    return text;
}

void check_outputs(const WellCommand& command) {
    const FileOptions& files = command.model.files;
    FileOptions inputs = files;
    inputs.outputs.clear();
    plan_outputs(inputs, OutputKind::surfaces);
    for (const std::string& path : files.outputs) {
        const WellFormat format = format_of_log(files, path);
        if (path != "-") check_folder(path);
        if (command.step > 0 && format != WellFormat::las) refuse("is for .las files", "--step");
    }
    const auto standard = std::ranges::count(files.outputs, "-");
    if (standard > 1 || (standard == 1 && (files.stats == "-" || files.report == "-")))
        refuse("standard output can take only one file");
}

Json json_of(std::span<const WellLog> logs, const SectionNames& names) {
    Json list = Json::array();
    for (const WellLog& log : logs) {
        std::vector<std::pair<std::uint32_t, double>> lengths; // of blocks, by their first interval
        double upon = 0;
        for (const WellInterval& in : log.intervals) {
            if (!in.surfaces.empty()) {
                upon += in.to - in.from;
                continue;
            }
            auto found =
                std::ranges::find(lengths, in.blocks[0], &std::pair<std::uint32_t, double>::first);
            if (found == lengths.end()) found = lengths.insert(lengths.end(), {in.blocks[0], 0});
            found->second += in.to - in.from;
        }
        Json blocks = Json::array();
        for (const auto& [block, length] : lengths)
            blocks.push_back(Json({{"name", names.blocks[block]}, {"length", length}}));
        list.push_back(Json({{"name", log.name},
                             {"from", log.intervals.front().from},
                             {"to", log.intervals.back().to},
                             {"intervals", log.intervals.size()},
                             {"markers", log.markers.size()},
                             {"blocks", std::move(blocks)},
                             {"in_surfaces", upon}}));
    }
    return list;
}

ExitStatus log_files(const WellCommand& command, const CLI::App& app, Session& session) {
    check_outputs(command);
    auto files = read_paths(command);
    check_names(command, files);
    auto run = ModelRun::begin(command.model, session);
    const auto paths = paths_of(std::move(files), run.inputs().unit);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const Model& model = *run.built().model;
    const auto logs = must(session.timed(
        "wells", [&] { return log_wells(model.mesh, model.volumes, paths, session.run()); }));
    SectionNames names = names_in(model);
    names.length_unit = run.inputs().unit;
    say(run.told(), text_of(logs, names, run.inputs().quantities()));
    run.statistics()["wells"] = json_of(logs, names);
    const bool meets = std::ranges::any_of(logs, meets_model);
    if (!meets) print(stderr, complaint("nothing written: no well meets the model"));
    if (meets)
        for (const std::string& output : command.model.files.outputs) {
            session.begin("write", Phase::writing);
            const auto written = write_wells(
                logs, names, format_of_log(command.model.files, output), output, command.step);
            if (!written) throw Failure{at_option(written.error(), app)};
            session.end_stage();
            for (const auto& path : *written) say_written(run.told(), path.string());
        }
    return run.end(meets);
}

} // namespace

Command well_command(CLI::App& program) {
    auto command = std::make_shared<WellCommand>();
    auto* app = program.add_subcommand("well", "Log the blocks and surfaces along wells");
    add_inputs(*app, command->model.files);
    add_output(*app, command->model.files, "File for the logs, .csv or .las; - is standard output");
    add_value(*app, "--path", command->paths, "FILE",
              "File with paths of wells: a table or LAS; may be repeated")
        ->allow_extra_args(false)
        ->required();
    add_value(*app, "--head", command->heads, "[WELL=]X,Y,Z",
              "Where a well with a deviation survey begins; may be repeated")
        ->allow_extra_args(false);
    add_value(*app, "--step", command->step, "LENGTH",
              "Distance of the depths in .las files (default: depths at which the block changes)")
        ->check(CLI::PositiveNumber.description(""));
    add_naming(*app, command->model);
    add_arranging(*app, command->model);
    add_run(*app, command->model.files);
    command->model.tells_blocks = false;
    command->model.project.last = BuildStage::blocks;
    app->footer(well_footer);
    return {app, [app, command] {
                Session session(command->model.files.threads);
                return log_files(*command, *app, session);
            }};
}

} // namespace terrane::cli
