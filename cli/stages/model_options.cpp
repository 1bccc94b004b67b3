// SPDX-License-Identifier: LGPL-3.0-or-later
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/max_move.hpp>
#include <terrane/cli/options/roles.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/stages/model_run.hpp>

namespace terrane::cli {
namespace {

constexpr unsigned most_rounds = 8;

/// Reads a positive number, or "auto", which is 0.
std::optional<double> positive_or_automatic(const std::string& text) {
    if (text == "auto") return 0;
    const auto number = parse_number(text);
    return number && *number > 0 ? number : std::nullopt;
}

constexpr const char* seal_option = "--seal";

/// Reads a distance for gaps: D, auto, or NAME=D for those of one surface or pair of surfaces.
void set_seal(const std::string& text, Project& project) {
    const auto refuse = [](const std::string& sentence) {
        throw CLI::ValidationError(seal_option, sentence);
    };
    if (text == "auto" || parse_number(text)) {
        if (!positive_or_automatic(text)) refuse("'" + text + "' is no positive number");
        if (project.seal) refuse("'" + text + "' is a second distance for all gaps");
        project.seal = positive_or_automatic(text);
        return;
    }
    const auto named = parse_named_length(text);
    if (!named) refuse("'" + text + "' is no positive number, nor auto, nor NAME=D");
    if (!(named->second >= 0)) refuse("'" + text + "' has no distance, at least 0, behind =");
    project.seal_of.push_back(*named);
}

void add_seal(CLI::App& command, Project& project) {
    command
        .add_option_function<std::vector<std::string>>(
            seal_option,
            [&project](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) set_seal(text, project);
            },
            "Extend or trim free borders that end short of another surface, or beyond it, by "
            "at most this distance; every change is listed; auto: the last natural break in "
            "the widths of gaps; NAME=D: for the gaps of this surface; NAME/NAME=D: for those "
            "between these two; 0: they stay open; may be repeated (default: nothing moves)")
        ->allow_extra_args(false)
        ->type_name("[NAME=]D");
}

} // namespace

void add_arranging(CLI::App& app, ModelCommand& command) {
    Project& project = command.project;
    project.check = few_pairs;
    static const std::map<std::string, Search> methods = [] {
        std::map<std::string, Search> all;
        for (const auto m : {Search::automatic, Search::grid, Search::ab, Search::ab_balanced,
                             Search::ab_median, Search::mixed, Search::bvh, Search::brute})
            all.emplace(name_of(m), m);
        return all;
    }();
    std::vector<std::string> words;
    for (const auto& [name, method] : methods) words.push_back(name);
    app.add_option("--search", project.search,
                   "How triangles that may meet are found; the result is the same: "
                   "auto, grid, ab, ab-balanced, ab-median, mixed, hierarchy, brute (default: "
                   "auto)")
        ->transform(CLI::Transformer(methods, CLI::ignore_case).description(""))
        ->transform(listing(words)) // else numbers would be taken
        ->type_name("METHOD");
    app.add_option("--rounds", project.max_rounds,
                   "Most rounds of snapping until the doubles are a conforming mesh; "
                   "0: only to the nearest double (default: 8)")
        ->check(CLI::Range(0U, most_rounds).description(""))
        ->type_name("N");
    app.add_option_function<double>(
           "--tolerance",
           [&project](double length) {
               if (!(length > 0) || !std::isfinite(length))
                   throw CLI::ValidationError("--tolerance", "needs a positive length");
               project.tolerance = length;
           },
           "What is nearer than this is one: borders and creases of surfaces join, and gaps and "
           "overlaps that are thinner vanish. No surface moves by more. Gaps of borders as wide are "
           "sealed, unless --seal is given (default: nothing is joined)")
        ->type_name("LENGTH");
    add_max_move(app, project.max_move);
    add_check(app, project.check);
    add_seal(app, project);
    app.add_option_function<std::string>(
           "--min-volume",
           [&project](const std::string& text) {
               project.min_volume = positive_or_automatic(text);
               if (!project.min_volume)
                   throw CLI::ValidationError("--min-volume",
                                              "'" + text + "' is no positive number, nor auto");
           },
           "Merge smaller blocks with a neighbour, by removing what lies between; auto: a "
           "cube of a tenth of the median edge length (default: none)")
        ->type_name("D|auto");
    add_volume_options(app, command.volume);
}

void add_naming(CLI::App& app, ModelCommand& command) {
    add_roles(app, command.roles);
    app.add_option("--column", command.column,
                   "Stratigraphic column: names blocks by their units, given from the top down "
                   "with the horizons at their bases")
        ->type_name("FILE.json");
}

} // namespace terrane::cli
