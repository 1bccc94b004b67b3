// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/quality/deviation.hpp>
#include <terrane/algorithms/quality/improve_measured.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/fields.hpp>
#include <terrane/cli/reports/improve_report.hpp>
#include <terrane/cli/reports/resolution_report.hpp>
#include <terrane/cli/stages/certificate_output.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/cli/stages/page_output.hpp>
#include <terrane/cli/stages/pipeline.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {
namespace {

struct ImproveCommand {
    FileOptions files;
    ArrangeSettings settings;
    ImproveOptions options;
    std::string edge_length = "auto";
    std::vector<std::string> edge_length_of; ///< NAME=L
    Resolution resolution;                   ///< of length 0: none
    std::string histogram;                   ///< empty: none
    ProofOptions proof;                      ///< a certificate only
};

constexpr auto improve_footer =
    R"(The surfaces are arranged and rounded first, as `terrane arrange` does; then triangles are made
better: smoothed, swapped, collapsed, split, all surfaces together. The mesh stays conforming: each
step is allowed only where exact predicates show that no triangles meet improperly by it, and the
whole is checked exactly at the end. Corners stay; curves (intersections, borders, creases) keep their vertices
on the curves as they were. No point moves farther than D from its surface, and no point of a surface as it was is farther than
D from it as it is: shown for all of each triangle, and measured again by other code before anything
is written.

q is 2 r / R, radius of the inscribed by that of the circumscribed circle, 1 for an equilateral
triangle.

Examples:
  terrane improve horizons.ts faults.ts -o model.vtp --edge-length 200
  terrane improve model.ml -o model.vtp --max-deviation 5 --histogram model.svg
  terrane improve horizons.ts -o model.vtp --edge-length 200 --certificate model.json
  terrane improve model.ml -o model.vtp --edge-length 400 --edge-length-of F1=150 --turn 15)";

/// Parses a positive number that takes up the whole text; returns none for anything else.
std::optional<double> positive(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [after, failed] = std::from_chars(text.data(), end, value); // obeys no locale
    if (failed != std::errc() || after != end || !(value > 0) || !std::isfinite(value))
        return std::nullopt;
    return value;
}

/// Judges the options by the surfaces as they were read, before these are arranged.
Status judge(const Inputs& inputs, const ImproveOptions& options) {
    double largest = 0;
    for (const Surface& s : inputs.surfaces)
        for (const Point3& p : s.vertices)
            largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    if (options.max_deviation > 0 && options.max_deviation < least_deviation(largest))
        return Error{ErrorCode::bad_option,
                     fmt::format("is too small for coordinates of this size; the least is {}",
                                 least_deviation(largest)),
                     "--max-deviation"};
    const double count = expected_triangles(inputs.surfaces, options);
    if (count > options.max_triangles)
        return Error{ErrorCode::bad_option,
                     fmt::format("about {} triangles are to be expected, more than the limit "
                                 "of {}; ask for longer edges or raise --max-triangles",
                                 figure(count, 3), figure(options.max_triangles)),
                     "--edge-length"};
    return Done{};
}

Status set_length_of(const std::string& text, const Inputs& inputs, std::vector<double>& lengths) {
    const auto at = text.rfind('=');
    const auto length = at == std::string::npos ? std::nullopt : positive(text.substr(at + 1));
    if (!length)
        return Error{ErrorCode::bad_option, "needs NAME=L, with a positive length: " + text,
                     "--edge-length-of"};
    const std::string name = text.substr(0, at);
    bool found = false;
    for (std::size_t s = 0; s < inputs.surfaces.size(); ++s) {
        if (inputs.surfaces[s].name != name && inputs.labels[s] != name) continue;
        lengths[s] = *length;
        found = true;
    }
    if (found) return Done{};
    return Error{ErrorCode::bad_option, not_called("surface", name, inputs.labels),
                 "--edge-length-of"};
}

Status set_lengths(const ImproveCommand& command, const Inputs& inputs, ImproveOptions& options) {
    if (command.edge_length != "auto") {
        const auto length = positive(command.edge_length);
        if (!length)
            return Error{ErrorCode::bad_option,
                         "needs a positive length or auto: " + command.edge_length,
                         "--edge-length"};
        options.edge_length = *length;
    }
    if (command.edge_length_of.empty()) return Done{};
    options.edge_length_of.assign(inputs.surfaces.size(), 0);
    for (const std::string& text : command.edge_length_of)
        if (auto set = set_length_of(text, inputs, options.edge_length_of); !set) return set;
    return Done{};
}

Status write_all(const ImproveCommand& command, const Inputs& inputs, const Arranged& arranged,
                 const ImprovedAndMeasured& measured, const std::vector<Output>& outputs,
                 Session& session) {
    if (!command.histogram.empty()) {
        const auto& report = measured.improved.report;
        if (auto drawn = write_file(command.histogram, histogram_of(report)); !drawn) return drawn;
        say_written(summary_stream(command.files), command.histogram);
    }
    auto written = write_outputs(measured.improved.mesh, true, command.files, outputs, session);
    if (!written || command.proof.certificate.empty()) return written;
    auto result = certified_arrangement(command.files.inputs, inputs, command.settings, arranged);
    if (!result) return result.error();
    auto files = certified_outputs(outputs, measured.improved.mesh, command.files.ascii);
    if (!files) return files.error();
    result->outputs = *std::move(files);
    result->improved = &measured.improved;
    return write_certificate(command.proof.certificate, *result, summary_stream(command.files),
                             session);
}

/// Checks the options before any work is done.
Status check_improve(const ImproveCommand& command) {
    if (!command.histogram.empty())
        if (auto folder = check_folder(command.histogram); !folder) return folder;
    if (auto sound = check_volume_options(command.settings.volume); !sound) return sound;
    if (auto named = plan_proof(command.proof, command.files); !named) return named;
    if (command.resolution.dissolve && command.resolution.length == 0)
        return Error{ErrorCode::bad_option, "needs --resolution", "--dissolve"};
    if (command.proof.certificate.empty()) return Done{};
    if (command.resolution.length > 0)
        return Error{ErrorCode::bad_option,
                     "a certificate can't show joining at a resolution yet; leave out "
                     "--resolution, or the certificate",
                     "--certificate"};
    if (auto possible = check_certifiable(command.settings); !possible) return possible;
    return check_certified_names(command.proof.certificate, command.settings.volume.within);
}

/// Simplifies the surfaces to --resolution and says what changed.
Status simplify(const ImproveCommand& command, const Inputs& inputs, ImproveOptions& options,
                Arranged& arranged, Session& session, Json& statistics) {
    session.begin("simplify", Phase::computing);
    auto done =
        simplify_to(command.resolution, options,
                    {.max_rounds = command.settings.rounds, .max_move = command.settings.max_move},
                    arranged, session.run());
    session.end_stage();
    if (!done) return done;
    const SimplifyReport& report = arranged.simplified->report;
    add_statistics(statistics, report, inputs);
    add_constants(statistics, "resolution", simplify_constants());
    say(summary_stream(command.files),
        session.timed("summary", [&] { return text_of(report, inputs); }));
    return Done{};
}

/// Warns of what keeps the improved mesh from being written.
void warn_of_changes(const ImprovedAndMeasured& measured) {
    if (!measured.improved.report.sides_kept)
        warn("a small piece came to lie beyond a surface near it, so the blocks would not be "
             "the same; try a smaller --max-deviation");
    if (!measured.is_near_back())
        warn("not all of each surface as it was is shown to be near enough to the improved one; "
             "try another --max-deviation");
}

/// Tells whether both steps together are shown to keep surfaces within --resolution of what they
/// were; warns where not.
bool keeps_resolution(const Arranged& arranged, const Mesh& improved, Session& session) {
    if (!arranged.simplified) return true;
    if (is_within_resolution(*arranged.simplified, improved, session.run())) return true;
    warn("not all of each surface is shown to be within --resolution of what it was; try a smaller "
         "--max-deviation");
    return false;
}

/// Says why nothing is written; `narrow`: the mesh is conforming as STL would hold it.
const char* refusal(bool narrow) {
    return narrow
               ? "The improved mesh may be too far from the one before, or its blocks may not be "
                 "the same."
               : not_conforming_in_stl;
}

Result<ExitStatus> improve_files(const ImproveCommand& command, Session& session) {
    const FileOptions& files = command.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (!outputs) return outputs.error();
    if (const auto sound = check_improve(command); !sound) return sound.error();
    auto page = plan_page(files, session);
    if (!page) return page.error();
    auto inputs = read_certified_inputs(command.proof.certificate, files, session);
    if (!inputs) return inputs.error();
    if (const auto added = add_page_inputs(*page, files, *inputs); !added) return added.error();
    ImproveOptions options = command.options;
    options.check = check_of(command.settings.check, inputs.value());
    if (const auto set = set_lengths(command, inputs.value(), options); !set) return set.error();
    if (const auto good = judge(inputs.value(), options); !good) return good.error();
    Json statistics = statistics_of(inputs.value());

    auto arranged = arrange_and_round(inputs.value(), command.settings, session, statistics);
    if (!arranged) return arranged.error();
    if (!options.edge_length_of.empty()) // the boundary of a volume of interest added surfaces
        options.edge_length_of.resize(inputs.value().labels.size());
    say(summary_stream(files),
        session.timed("summary", [&] { return summary(inputs.value(), arranged.value()); }));
    page->add_arranged(*arranged);
    bool clean = arranged.value().rounded.report.clean;
    if (!clean) {
        print(stderr, offending_pairs(inputs.value(), arranged.value()));
        print(stderr, complaint("only a conforming mesh can be improved; nothing written"));
    } else {
        if (command.resolution.length > 0)
            if (const auto done =
                    simplify(command, *inputs, options, *arranged, session, statistics);
                !done)
                return done.error();
        session.begin("improve", Phase::computing);
        const auto measured =
            improve_and_measure(*arranged.value().rounded.conforming, options, session.run());
        session.end_stage();
        if (!measured) return measured.error();
        add_statistics(statistics, measured.value());
        say(summary_stream(files), session.timed("summary", [&] {
            return improve_text(measured.value(), inputs.value());
        }));
        page->add_improved(measured->improved.mesh, arranged->rounded.mesh);
        const Mesh& mesh = measured.value().improved.mesh;
        const auto narrow = stl_is_conforming(mesh, files, outputs.value(), session);
        if (!narrow) return narrow.error();
        clean = narrow.value() && measured.value().improved.report.sides_kept &&
                measured.value().is_near_back();
        warn_of_changes(*measured);
        clean = keeps_volumes(measured.value(), files.strict, options) && clean;
        clean = keeps_resolution(*arranged, mesh, session) && clean;
        if (!clean) page->set_verdict(refusal(narrow.value()), false);
        if (clean) {
            const auto written = write_all(command, inputs.value(), arranged.value(),
                                           measured.value(), outputs.value(), session);
            if (!written) return written.error();
        } else {
            print(stderr, complaint("nothing written"));
        }
    }
    add_page_certificate(*page, files, command.proof.certificate, clean, session);
    return write_run(*page, statistics, files, session, clean);
}

/// Adds the options of improvement; those of lengths as texts, which are read with the surfaces.
void add_improvement(CLI::App& app, ImproveCommand& command) {
    ImproveOptions::describe(
        [&](const Field& field, const auto&) {
            if (field.name == "edge_length")
                app.add_option("--edge-length", command.edge_length,
                               help_of(field) + "; auto: " + std::string(field.otherwise) +
                                   " (default: auto)")
                    ->type_name("L");
            if (field.name == "edge_length_of")
                app.add_option("--edge-length-of", command.edge_length_of,
                               help_of(field) + "; may be repeated")
                    ->allow_extra_args(false)
                    ->type_name("NAME=L");
        },
        command.options);
    add_fields(app, command.options);
    add_fields(app, command.resolution);
    app.get_option("--strict")
        ->description(
            "Stop with status 2 at warnings about the inputs, and with status 1 where the volume "
            "of a block changes too much; nothing is written then");
}

} // namespace

Command improve_command(CLI::App& program) {
    auto command = std::make_shared<ImproveCommand>();
    auto* app = program.add_subcommand("improve", "Make better triangles, conforming all the way");
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the mesh; - is standard output");
    add_improvement(*app, *command);
    app->add_option("--histogram", command->histogram, "Histograms of q before and after")
        ->type_name("FILE.svg");
    add_settings(*app, command->settings);
    app->add_flag("--ascii", command->files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, command->files);
    add_certificate(*app, command->proof.certificate);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    add_report(*app, command->files);
    app->footer(improve_footer);
    return {app, [command, app] {
                if (const auto good = check_fields<ImproveOptions>(*app); !good)
                    return fail(good.error());
                if (const auto good = check_fields<Resolution>(*app); !good)
                    return fail(good.error());
                Session session(command->files.threads);
                const auto status = improve_files(*command, session);
                return status ? status.value() : fail(status.error());
            }};
}

} // namespace terrane::cli
