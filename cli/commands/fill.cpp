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
meet these points. Both foresee their errors. The surface keeps all its vertices and triangles; new
ones come after them and share the border's vertices. Where new triangles would cross others, nothing
is written. VTP gets arrays interpolated (the number of the hole, 0 for what was given)
and deviation (the expected error, mean of the corners). A hole that can't be filled is named and
left open, and the exit status is 1.

Examples:
  terrane fill top.irap --list
  terrane fill --depth top.irap -o top.vtp --map top.svg
  terrane fill horizons.ts -o filled.ts --holes 1,3 --points interpolated.csv
  terrane fill fold.obj -o filled.obj --method rbf --certificate filled.json)";

/// Reads the numbers of the holes to fill; none: all.
Result<std::optional<std::vector<std::size_t>>> holes_of(const FillCommand& command) {
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
            return usage(fmt::format("{} is no number of a hole: see --list", token), "--holes");
        numbers.push_back(number);
    }
    return std::optional(std::move(numbers));
}

Status write_all(const FillCommand& command, const std::vector<Output>& outputs, ModelRun& run,
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
    for (const Output& output : outputs) {
        WriteOptions options{.ascii = files.ascii};
        if (output.format == Format::vtp) options.cells = cells;
        if (const auto written = write_output(mesh, output, options, session); !written)
            return written.error();
        tell_when_written(run.told(), wrote(output));
    }
    if (!command.map.empty())
        if (auto written = write_file(command.map, map_of(work)); !written) return written;
    if (!command.points.empty())
        if (auto written = write_file(command.points, csv_of(work)); !written) return written;
    auto written = certified_outputs(outputs, mesh, files.ascii);
    if (!written) return written.error();
    return run.certify(*std::move(written));
}

Result<std::vector<Output>> plan(const FillCommand& command) {
    auto outputs = plan_outputs(command.model.files, OutputKind::surfaces);
    if (!outputs) return outputs;
    if (outputs->empty() && !command.list) return usage("-o OUT is needed, or --list");
    for (const auto& path : {command.map, command.points})
        if (!path.empty())
            if (const auto folder = check_folder(path); !folder) return folder.error();
    return outputs;
}

Result<ExitStatus> list_holes(ModelRun& run, const FillOptions& options, Session& session) {
    std::vector<FillTask> tasks;
    for (std::uint32_t s = 0; s < run.surfaces().size(); ++s)
        tasks.push_back({SurfaceId(s), options});
    session.begin("holes", Phase::computing);
    const auto work = find_holes(run.surfaces(), tasks, session.run());
    session.end_stage();
    if (!work) return work.error();
    print(run.told(), borders_text(*work) + holes_table(*work));
    add_statistics(run.statistics(), *work);
    run.page().add_filled(*work);
    run.page().set_verdict("Holes are listed, and none is filled.", true);
    return run.end(true);
}

Status read_smoothing(FillCommand& command) {
    const std::string& text = command.smoothing;
    if (text == no_smoothing) return Done{};
    if (command.method != "rbf")
        return Error{ErrorCode::bad_option, "is of --method rbf", "--smoothing"};
    const auto length = text == "auto" ? 0.0 : parse_number(text);
    if (!length || (text != "auto" && !(*length > 0)))
        return usage("needs none, auto or a length: " + text, "--smoothing");
    command.settings.smoothing = *length;
    return Done{};
}

/// Refuses options that --method rbf would not heed.
Status refuse_for_rbf(const CLI::App& app, const FillCommand& command) {
    if (command.method != "rbf") return Done{};
    for (const char* const name : {"--model", "--isotropic", "--rings"})
        if (app.count(name) > 0)
            return Error{ErrorCode::bad_option, "is of --method kriging", name};
    return Done{};
}

Result<ExitStatus> fill_files(FillCommand& command, Session& session) {
    const auto outputs = plan(command);
    if (!outputs) return outputs.error();
    auto holes = holes_of(command);
    if (!holes) return holes.error();
    FillOptions options = command.settings;
    if (command.method == "rbf") options.method = FillMethod::rbf;
    options.model = variogram_model_named(command.variogram);
    command.model.project.fill = {{.options = options}};
    command.model.project.only_holes = *std::move(holes);
    auto run = ModelRun::begin(command.model, session);
    if (!run) return run.error();
    if (command.list) return list_holes(*run, options, session);
    if (auto made = run->make(); !made) return made.error();
    if (!run->refused().empty()) return run->end(false);
    const auto left_open = refusals_text(*run->built().preprocessed.filled);
    print(stderr, left_open);
    if (auto done = write_all(command, *outputs, *run, session); !done) return done.error();
    return run->end(left_open.empty());
}

void add_choice(CLI::App& app, FillCommand& command) {
    app.add_option("--holes", command.holes,
                   "Which ones, by the numbers of --list: all, or N,N,... (default: all)")
        ->type_name("LIST");
    add_fields(app, command.settings);
    app.add_flag("--list", command.list, "Say which holes there are, and fill none");
}

void add_method(CLI::App& app, FillCommand& command) {
    app.add_option("--method", command.method,
                   "kriging, for z = f(x, y), or rbf, for any surface (default: kriging)")
        ->check(one_of({"kriging", "rbf"}))
        ->type_name("METHOD");
    app.add_option(
           "--model", command.variogram,
           "Of the variogram of kriging: auto, spherical, exponential, gaussian, matern, power "
           "(default: auto, "
           "all but spherical count, as likely as they are)")
        ->check(one_of({"auto", "spherical", "exponential", "gaussian", "matern", "power"}))
        ->type_name("MODEL");
    app.add_option("--smoothing", command.smoothing,
                   "Of rbf: none; auto, as much as predicts data best from others; or the root "
                   "mean square by which data may be missed (default: none)")
        ->type_name("none|auto|LENGTH");
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
    app->add_option("--map", options->map, "Draw it before and after, and the expected error")
        ->type_name("FILE.svg");
    app->add_option("--points", options->points,
                    "Write interpolated points with deviation and variance")
        ->type_name("FILE.csv");
    app->add_flag("--ascii", options->model.files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->model.files);
    add_certificate(*app, options->model.proof.certificate);
    add_threads(*app, options->model.files);
    add_stats(*app, options->model.files);
    add_report(*app, options->model.files);
    options->model.project.last = BuildStage::preprocess;
    app->footer(fill_footer);
    return {app, [app, options] {
                if (const auto good = check_fields<FillOptions>(*app); !good)
                    return fail(good.error());
                if (const auto good = refuse_for_rbf(*app, *options); !good)
                    return fail(good.error());
                if (const auto read = read_smoothing(*options); !read) return fail(read.error());
                Session session(options->model.files.threads);
                const auto status = fill_files(*options, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
