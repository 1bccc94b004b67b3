// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/fill_report.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

constexpr const char* default_holes = "all";
constexpr const char* no_smoothing = "none";

struct FillCommand {
    FileOptions files;
    FillOptions settings;
    std::string method = "kriging";       ///< or rbf
    std::string model = "auto";           ///< of the variogram
    std::string smoothing = no_smoothing; ///< text of the option
    std::string holes = default_holes;
    bool list = false;
    std::string map;    ///< empty: none
    std::string points; ///< empty: none
    ProofOptions proof; ///< a certificate only
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

/// Tells for each hole whether it is to be filled. Errors: bad_option.
Result<std::vector<bool>> chosen_holes(const FillCommand& command, const FillWork& work) {
    auto chosen = wanted_holes(work);
    if (command.holes == default_holes) return chosen;
    std::vector<bool> named(chosen.size());
    std::string_view rest = command.holes;
    while (!rest.empty()) {
        const auto token = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(token.size() + 1, rest.size()));
        std::size_t number = 0;
        for (const char c : token)
            number = c >= '0' && c <= '9' && number <= named.size()
                         ? 10 * number + static_cast<std::size_t>(c - '0')
                         : named.size() + 1;
        if (number < 1 || number > named.size())
            return Error{
                ErrorCode::bad_option,
                fmt::format("there is no hole {}, only 1 to {}: see --list", token, named.size()),
                "--holes"};
        named[number - 1] = true;
    }
    for (std::size_t i = 0; i < named.size(); ++i) chosen[i] = chosen[i] && named[i];
    return chosen;
}

Status write_all(const FillCommand& command, const std::vector<Output>& outputs,
                 const Inputs& inputs, const FillWork& work, Session& session) {
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
        WriteOptions options{.ascii = command.files.ascii};
        if (output.format == Format::vtp) options.cells = cells;
        if (const auto written = write_output(mesh, output, options, session); !written)
            return written.error();
        tell_when_written(summary_stream(command.files), wrote(output));
    }
    if (!command.map.empty())
        if (auto written = write_file(command.map, map_of(work)); !written) return written;
    if (!command.points.empty())
        if (auto written = write_file(command.points, csv_of(work)); !written) return written;
    if (command.proof.certificate.empty()) return Done{};
    auto certified = certified_outputs(outputs, mesh, command.files.ascii);
    if (!certified) return certified.error();
    CertifiedResult result{.inputs = certified_inputs(command.files.inputs, inputs),
                           .outputs = *std::move(certified),
                           .surfaces = inputs.surfaces};
    for (const HoledSurface& s : work.surfaces)
        result.filled.push_back(
            {&s.filled, s.given_vertices, s.given_triangles, s.interpolated, s.deviation});
    return write_certificate(command.proof.certificate, result, summary_stream(command.files),
                             session);
}

Result<std::vector<Output>> plan(const FillCommand& command) {
    auto outputs = plan_outputs(command.files, OutputKind::surfaces);
    if (!outputs) return outputs;
    if (outputs.value().empty() && !command.list)
        return Error{ErrorCode::bad_option, "-o OUT is needed, or --list", ""};
    for (const auto& path : {command.map, command.points})
        if (!path.empty())
            if (const auto folder = check_folder(path); !folder) return folder.error();
    if (const auto named = plan_proof(command.proof, command.files); !named) return named.error();
    return outputs;
}

/// Makes one task per surface, each with all of its holes.
std::vector<FillTask> tasks_of(const FillCommand& command, const Inputs& inputs) {
    FillOptions options = command.settings;
    if (command.method == "rbf") options.method = FillMethod::rbf;
    options.model = variogram_model_named(command.model);
    std::vector<FillTask> tasks;
    for (std::uint32_t s = 0; s < inputs.surfaces.size(); ++s)
        tasks.push_back({SurfaceId(s), options});
    return tasks;
}

/// The outcome of the chosen holes.
struct FillOutcome {
    bool written = false; ///< otherwise new triangles meet others improperly
    bool whole = false;   ///< no chosen hole stayed open
};

/// Fills the chosen holes and writes the results.
Result<FillOutcome> fill_and_write(const FillCommand& command, const std::vector<Output>& outputs,
                                   const Inputs& inputs, FillWork& work, Session& session) {
    const auto chosen = chosen_holes(command, work);
    if (!chosen) return chosen.error();
    session.begin("fill", Phase::computing);
    if (const auto done = fill_holes(inputs.surfaces, chosen.value(), work, session.run()); !done)
        return done.error();
    session.end_stage();
    say(summary_stream(command.files), session.timed("summary", [&] { return filled_text(work); }));
    const auto refused = refusals_text(work);
    print(stderr, refused);
    session.begin("check", Phase::computing);
    const auto contacts = contacts_of_new(work, session.run());
    session.end_stage();
    if (!contacts) return contacts.error();
    if (!contacts.value().empty()) {
        print(stderr, complaint("nothing written: new triangles meet other triangles") +
                          contacts_text(work, contacts.value()));
        return FillOutcome{};
    }
    if (const auto done = write_all(command, outputs, inputs, work, session); !done)
        return done.error();
    return FillOutcome{true, refused.empty()};
}

/// Returns a sentence about the result.
const char* verdict_on(const FillOutcome& outcome, bool listed) {
    if (listed) return "Holes are listed, and none is filled.";
    if (!outcome.written)
        return "New triangles meet others of their surface improperly. Nothing was written.";
    return page::filling_verdict(outcome.whole);
}

Status read_smoothing(FillCommand& command) {
    const std::string& text = command.smoothing;
    if (text == no_smoothing) return Done{};
    if (command.method != "rbf")
        return Error{ErrorCode::bad_option, "is of --method rbf", "--smoothing"};
    double length = 0;
    if (text != "auto") {
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, length);
        if (read.ec != std::errc{} || read.ptr != end || !(length > 0) || !std::isfinite(length))
            return Error{ErrorCode::bad_option, "needs none, auto or a length: " + text,
                         "--smoothing"};
    }
    command.settings.smoothing = length;
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

Result<ExitStatus> fill_files(const FillCommand& command, Session& session) {
    const auto outputs = plan(command);
    if (!outputs) return outputs.error();
    auto page = plan_page(command.files, session);
    if (!page) return page.error();
    const auto inputs = read_certified_inputs(command.proof.certificate, command.files, session);
    if (!inputs) return inputs.error();
    if (const auto added = add_page_inputs(*page, command.files, *inputs); !added)
        return added.error();
    Json statistics = statistics_of(inputs.value());
    if (const auto sound = examine(inputs.value(), {}, session, statistics); !sound)
        return sound.error();
    session.begin("holes", Phase::computing);
    auto work =
        find_holes(inputs.value().surfaces, tasks_of(command, inputs.value()), session.run());
    session.end_stage();
    if (!work) return work.error();
    if (command.list)
        print(summary_stream(command.files),
              borders_text(work.value()) + holes_table(work.value()));
    else
        say(summary_stream(command.files), borders_text(work.value()));
    FillOutcome outcome{false, true};
    if (!command.list) {
        const auto filled =
            fill_and_write(command, outputs.value(), inputs.value(), work.value(), session);
        if (!filled) return filled.error();
        outcome = *filled;
    }
    add_statistics(statistics, work.value());
    page->add_filled(*work);
    page->set_verdict(verdict_on(outcome, command.list), outcome.whole);
    add_page_certificate(*page, command.files, command.proof.certificate, outcome.written, session);
    return write_run(*page, statistics, command.files, session, outcome.whole);
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
           "--model", command.model,
           "Of the variogram of kriging: auto, spherical, exponential, gaussian, matern, power "
           "(default: auto, "
           "what fits best)")
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
    add_inputs(*app, options->files);
    add_output(*app, options->files, "File for the surfaces; - is standard output");
    app->get_option("--output")->required(false);
    add_method(*app, *options);
    add_choice(*app, *options);
    app->add_option("--map", options->map, "Draw it before and after, and the expected error")
        ->type_name("FILE.svg");
    app->add_option("--points", options->points,
                    "Write interpolated points with deviation and variance")
        ->type_name("FILE.csv");
    app->add_flag("--ascii", options->files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, options->files);
    add_certificate(*app, options->proof.certificate);
    add_threads(*app, options->files);
    add_stats(*app, options->files);
    add_report(*app, options->files);
    app->footer(fill_footer);
    return {app, [app, options] {
                if (const auto good = check_fields<FillOptions>(*app); !good)
                    return fail(good.error());
                if (const auto good = refuse_for_rbf(*app, *options); !good)
                    return fail(good.error());
                if (const auto read = read_smoothing(*options); !read) return fail(read.error());
                Session session(options->files.threads);
                const auto status = fill_files(*options, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
