// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

constexpr const char* default_holes = "all";
constexpr const char* no_smoothing = "none";

struct FillCommand {
    ModelCommand model;
    FillOptions settings;
    std::string method = "kriging";       ///< or rbf
    std::string variogram = "auto";       ///< its model
    std::string smoothing = no_smoothing; ///< text of the option
    std::string holes = default_holes;
    bool list = false;
    std::string map;    ///< empty: none
    std::string points; ///< empty: none
};

constexpr auto fill_footer =
    R"(Holes are the borders of a surface other than the one round it. A hole whose sides face each other
with a throw is a gap torn by a fault; gaps are left open unless --bridge-faults. --list says what
there is, by the numbers that --holes takes.

kriging needs a surface that is z = f(x, y) round the hole. rbf (the zero level of a radial basis
function through points round the hole) takes any surface, folds too; with --smoothing it need not
meet these points. Of z = f(x, y), errors are foreseen. The surface keeps all its vertices and
triangles; new ones come after them and share the border's vertices. Where new triangles would cross
others, nothing is written. VTP gets arrays interpolated (the number of the hole, 0 for what was given)
and deviation (the expected error, mean of the corners). A hole that can't be filled is named and
left open, and the exit status is 1.

Examples:
  terrane fill top.irap --list
  terrane fill --depth top.irap -o top.vtp --map top.svg
  terrane fill horizons.ts -o filled.ts --holes 1,3 --points interpolated.csv
  terrane fill fold.obj -o filled.obj --method rbf --certificate filled.json)";

/// Reads the numbers of the holes to fill; none: all.
std::optional<std::vector<std::size_t>> holes_of(const FillCommand& command) {
    if (command.holes == default_holes) return std::optional<std::vector<std::size_t>>();
    std::vector<std::size_t> numbers;
    std::string_view rest = command.holes;
    while (!rest.empty()) {
        const auto token = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(token.size() + 1, rest.size()));
        std::size_t number = 0;
        const auto [end, failed] =
            std::from_chars(token.data(), token.data() + token.size(), number);
        if (failed != std::errc() || end != token.data() + token.size())
            refuse(fmt::format("{} is no number of a hole: see --list", token), "--holes");
        numbers.push_back(number);
    }
    return std::optional(std::move(numbers));
}

void write_all(const FillCommand& command, const std::vector<Output>& outputs, ModelRun& run,
               Session& session) {
    const FillWork& work = *run.built().preprocessed.filled;
    const FileOptions& files = command.model.files;
    std::vector<Surface> surfaces;
    std::vector<std::int32_t> interpolated;
    std::vector<double> deviation;
    for (const HoledSurface& s : work.surfaces) {
        surfaces.push_back(s.filled);
        interpolated.insert(interpolated.end(), s.interpolated.begin(), s.interpolated.end());
        for (const Triangle& t : s.filled.triangles)
            deviation.push_back((s.deviation[t[0]] + s.deviation[t[1]] + s.deviation[t[2]]) / 3);
    }
    const Mesh mesh = concatenate(surfaces);
    const std::vector<CellArray> cells{{"interpolated", interpolated}, {"deviation", deviation}};
    const auto values = run.values_on(mesh);
    for (const Output& output : outputs) {
        WriteOptions options{.ascii = files.ascii, .values = values};
        if (output.format == Format::vtp) options.cells = cells;
        write_output(mesh, output, options, session);
        tell_when_written(run.told(), wrote(output));
    }
    if (!command.map.empty()) must(write_file(command.map, map_of(work)));
    if (!command.points.empty()) must(write_file(command.points, csv_of(work)));
    run.certify(certified_outputs(outputs, mesh, files.ascii));
}

std::vector<Output> plan(const FillCommand& command) {
    auto outputs = plan_outputs(command.model.files, OutputKind::surfaces);
    if (outputs.empty() && !command.list) refuse("-o OUT is needed, or --list");
    for (const auto& path : {command.map, command.points})
        if (!path.empty()) check_folder(path);
    return outputs;
}

ExitStatus list_holes(ModelRun& run, const FillOptions& options, Session& session) {
    std::vector<FillTask> tasks;
    for (std::uint32_t s = 0; s < run.surfaces().size(); ++s)
        tasks.push_back({SurfaceId(s), options});
    session.begin("holes", Phase::computing);
    const auto work = must(find_holes(run.surfaces(), tasks, session.run()));
    session.end_stage();
    print(run.told(), borders_text(work) + holes_table(work));
    add_statistics(run.statistics(), work);
    run.page().add_filled(work);
    run.page().set_verdict("Holes are listed, and none is filled.", true);
    return run.end(true);
}

void read_smoothing(FillCommand& command) {
    const std::string& text = command.smoothing;
    if (text == no_smoothing) return;
    if (command.method != "rbf") refuse("is of --method rbf", "--smoothing");
    const auto length = text == "auto" ? 0.0 : parse_number(text);
    if (!length || (text != "auto" && !(*length > 0)))
        refuse("needs none, auto or a length: " + text, "--smoothing");
    command.settings.smoothing = *length;
}

/// Refuses options that --method rbf would not heed.
void refuse_for_rbf(const CLI::App& app, const FillCommand& command) {
    if (command.method != "rbf") return;
    for (const char* const name : {"--model", "--isotropic", "--rings"})
        if (app.count(name) > 0) refuse("is of --method kriging", name);
}

ExitStatus fill_files(FillCommand& command, Session& session) {
    const auto outputs = plan(command);
    auto holes = holes_of(command);
    FillOptions options = command.settings;
    if (command.method == "rbf") options.method = FillMethod::rbf;
    options.model = variogram_model_named(command.variogram);
    command.model.project.fill = {{.options = options}};
    command.model.project.only_holes = std::move(holes);
    auto run = ModelRun::begin(command.model, session);
    if (command.list) return list_holes(run, options, session);
    run.make();
    if (!run.refused().empty()) return run.end(false);
    const auto left_open = refusals_text(*run.built().preprocessed.filled);
    print(stderr, left_open);
    write_all(command, outputs, run, session);
    return run.end(left_open.empty());
}

void add_choice(CLI::App& app, FillCommand& command) {
    add_value(app, "--holes", command.holes, "LIST",
              "Which ones, by the numbers of --list: all, or N,N,... (default: all)");
    add_fields(app, command.settings);
    app.add_flag("--list", command.list, "Say which holes there are, and fill none");
}

void add_method(CLI::App& app, FillCommand& command) {
    add_value(app, "--method", command.method, "METHOD",
              "kriging, for z = f(x, y), or rbf, for any surface (default: kriging)")
        ->check(one_of({"kriging", "rbf"}));
    add_value(app, "--model", command.variogram, "MODEL",
              "Of the variogram of kriging: auto, spherical, exponential, gaussian, matern, power "
              "auto: all but spherical count, as likely as they are (default: auto)")
        ->check(one_of({"auto", "spherical", "exponential", "gaussian", "matern", "power"}));
    add_value(app, "--smoothing", command.smoothing, "none|auto|LENGTH",
              "Of rbf: none; auto, as much as predicts data best from others; or the root "
              "mean square by which data may be missed (default: none)");
}

} // namespace

Command fill_command(CLI::App& program) {
    auto options = std::make_shared<FillCommand>();
    auto* app =
        program.add_subcommand("fill", "Fill the holes of surfaces, and say how sure it is");
    add_inputs(*app, options->model.files);
    add_output(*app, options->model.files, "File for the surfaces; - is standard output");
    app->get_option("--output")->required(false);
    add_method(*app, *options);
    add_choice(*app, *options);
    add_value(*app, "--map", options->map, "FILE.svg",
              "Draw it before and after, and the expected error");
    add_value(*app, "--points", options->points, "FILE.csv",
              "Write interpolated points with deviation and variance");
    app->add_flag("--ascii", options->model.files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->model.files);
    add_certificate(*app, options->model.proof.certificate);
    add_run(*app, options->model.files);
    options->model.project.last = BuildStage::preprocess;
    app->footer(fill_footer);
    return {app, [app, options] {
                check_fields<FillOptions>(*app);
                refuse_for_rbf(*app, *options);
                read_smoothing(*options);
                Session session(options->model.files.threads);
                return fill_files(*options, session);
            }};
}

} // namespace terrane::cli
