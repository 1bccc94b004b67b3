// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/selection/selection.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/max_move.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/arranged_report.hpp>
#include <terrane/cli/stages/model_run.hpp>
#include <terrane/cli/stages/outputs.hpp>
#include <terrane/cli/stages/plausibility.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

struct SelectCommand {
    FileOptions files;
    std::string expression;
    std::string rule = "nonzero";
    bool splits = false; ///< whether each piece has a file of its own
    SelectOptions settings;
};

constexpr auto select_footer =
    R"text(Operands are closed surfaces by their names in the files; a name with other characters than letters,
digits, _ and . stands in double quotes. Operators as in Python, from the strongest: ~ complement,
- difference, & intersection, ^ symmetric difference, | union. Surfaces may cross themselves and each other,
touch and overlap. Triangles face outwards. The boundary is written only if its doubles are conforming, by an
exact check; if they are not, or the region is empty, the exit status is 1.

A surface that is not closed has sides: below(S) and above(S), west(S) and east(S), south(S) and north(S). A
part of it is selected by functions: "fault & below(top)", "horizon & inside(body)". hull(S) is all that S keeps
from infinity, whether or not S is closed.

Examples:
  terrane select "(a | b) - c" a.stl b.stl c.stl -o region.obj
  terrane select "reservoir - salt" model.ts -o rest.vtp --fractions
  terrane select "salt & below(topography)" salt.ts topography.ts -o salt_below.ts
  terrane select "hull(scan)" scan.ply -o outside.ply)text";

std::string volume_text(double volume, const std::string& exact, const Quantities& quantities) {
    return "volume " + quantities.volume(volume) + (exact.empty() ? "" : ", exactly " + exact);
}

std::string region_text(const Selected& made, const Quantities& quantities) {
    constexpr std::size_t most_pieces = 20; // printed
    if (made.is_surface && made.regions > 0)
        return fmt::format("surface: {}, {}\n", counted(made.mesh.triangles.size(), "triangle"),
                           counted(made.regions, "region")) +
               text_of(made.rounding, quantities);
    if (made.pieces.empty())
        return made.is_surface ? "surface: nothing of it is left\n" : "region: empty\n";
    const auto triangles =
        [&](std::size_t count) { // there are none if the doubles are not conforming
            return made.rounding.clean ? counted(count, "triangle") + ", " : "";
        };
    std::size_t number = 0;
    auto text =
        fmt::format("region: {}{}, {}, {}\n", triangles(made.mesh.triangles.size()),
                    counted(made.pieces.size(), "piece"),
                    made.cavities == 1 ? "1 cavity" : fmt::format("{} cavities", made.cavities),
                    volume_text(made.volume, made.exact_volume, quantities));
    if (made.pieces.size() > 1)
        text += listed(made.pieces, most_pieces, [&](const SelectedPiece& piece) {
            return fmt::format(
                "  piece {}: {}{}{}\n", ++number, triangles(piece.triangles),
                volume_text(piece.volume, piece.exact_volume, quantities),
                made.rounding.clean && piece.triangles == 0 ? ", too thin for doubles" : "");
        });
    return text + text_of(made.rounding, quantities);
}

/// Lists the places where doubles are not conforming.
std::string places_of(const RoundingReport& rounding, const Quantities& quantities) {
    constexpr std::size_t most_places = 20; // printed
    return listed(rounding.contacts, most_places, [&](const ImproperContact& c) {
        return fmt::format("  {} at {}\n", name_of(c.kind), quantities.place(c.place));
    });
}

void add_region(Json& json, const Selected& made, const SelectCommand& command) {
    add_statistics(json, made.arrangement);
    const auto with_exact = [](Json one, const std::string& exact) {
        if (!exact.empty()) one["exact_volume"] = exact;
        return one;
    };
    Json region = with_exact({{"expression", command.expression},
                              {"rule", command.rule},
                              {"triangles", made.mesh.triangles.size()},
                              {"volume", made.volume},
                              {"cavities", made.cavities},
                              {"pieces", Json::array()}},
                             made.exact_volume);
    if (made.is_surface) region["regions"] = made.regions;
    for (const SelectedPiece& piece : made.pieces)
        region["pieces"].push_back(with_exact(
            {{"triangles", piece.triangles}, {"volume", piece.volume}}, piece.exact_volume));
    json["region"] = std::move(region);
    json["rounding"] = made.rounding;
    add_constants(json, "round", rounding_constants());
}

/// Returns the output for a piece: "out-2.obj" for "out.obj".
Output output_of_piece(const Output& output, std::size_t number) {
    std::filesystem::path path = output.path;
    path.replace_filename(path.stem().string() + "-" + std::to_string(number) +
                          path.extension().string());
    return {path.string(), output.format};
}

/// Writes the result, or each piece that doubles hold.
void write_selected(const Selected& made, const Inputs& inputs, const SelectCommand& command,
                    const std::vector<Output>& outputs, Session& session) {
    const auto write = [&](const Mesh& mesh, const Output& output) {
        const auto values =
            carry_values({.given = inputs.surfaces, .parents = inputs.surfaces}, mesh);
        write_output(mesh, output, {.ascii = command.files.ascii, .values = values}, session);
        tell_when_written(summary_stream(command.files), wrote(output));
    };
    for (const Output& output : outputs) {
        if (!command.splits || made.is_surface) {
            write(made.mesh, output);
            continue;
        }
        for (std::uint32_t p = 0; p < made.pieces.size(); ++p)
            if (made.pieces[p].triangles > 0)
                write(made.piece(p), output_of_piece(output, p + std::size_t{1}));
    }
}

ExitStatus select_files(SelectCommand& command, const CLI::App& app, Session& session) {
    const FileOptions& files = command.files;
    const auto outputs = plan_outputs(files, OutputKind::surfaces);
    if (command.splits && std::ranges::count(outputs, "-", &Output::path) > 0)
        refuse("takes the name of a file: each piece has one of its own", "--split");
    command.settings.rule = *inside_rule_named(command.rule);
    const auto inputs = read_inputs(files, session);
    Json statistics = statistics_of(inputs);
    examine(inputs.surfaces, {}, inputs, session, statistics);
    const auto selected = session.timed("select", [&] {
        return select(inputs.surfaces, command.expression, command.settings, session.run());
    });
    if (!selected) throw Failure{at_option(selected.error(), app)};
    const Selected& made = *selected;
    add_region(statistics, made, command);
    std::FILE* const told = summary_stream(files);
    say(told, region_text(made, inputs.quantities()));
    if (!made.rounding.clean) print(stderr, places_of(made.rounding, inputs.quantities()));
    const bool writes = made.rounding.clean && !made.mesh.triangles.empty() &&
                        stl_is_conforming(made.mesh, files, outputs, session);
    const bool vanished =
        made.rounding.clean && !made.pieces.empty() && made.mesh.triangles.empty();
    if (!writes)
        print(stderr,
              complaint(vanished ? "nothing written: all of it vanishes where points become doubles"
                                 : "nothing written"));
    if (writes) write_selected(made, inputs, command, outputs, session);
    write_statistics(std::move(statistics), files.stats, session);
    return writes ? ExitStatus::done : ExitStatus::negative;
}

} // namespace

Command select_command(CLI::App& program) {
    auto command = std::make_shared<SelectCommand>();
    auto* app = program.add_subcommand("select", "Unite, intersect and subtract closed surfaces");
    add_value(*app, "EXPRESSION", command->expression, "TEXT",
              "The region, by names of surfaces: \"(a | b) - c\"")
        ->required();
    add_inputs(*app, command->files);
    add_output(*app, command->files, "File for the boundary; - is standard output");
    add_value(*app, "--rule", command->rule, "RULE",
              "Winding numbers of points inside of a surface: nonzero, positive or odd "
              "(default: nonzero)")
        ->check(one_of({"nonzero", "positive", "odd"}));
    app->add_flag("--split", command->splits,
                  "Write each piece to a file of its own: OUT-1.obj, OUT-2.obj, ...");
    app->add_flag("--fractions", command->settings.fractions, "Give volumes as fractions, too");
    add_max_move(*app, command->settings.rounding.max_move);
    app->add_flag("--ascii", command->files.ascii, "STL as text, with doubles, not float32");
    add_msh(*app, command->files);
    add_threads(*app, command->files);
    add_stats(*app, command->files);
    app->footer(select_footer);
    return {app, [app, command] {
                Session session(command->files.threads);
                return select_files(*command, *app, session);
            }};
}

} // namespace terrane::cli
