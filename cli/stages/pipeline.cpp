// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/pipeline.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/model/seal_rules.hpp>
#include <terrane/algorithms/volume_of_interest/boundary_surfaces.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/max_move.hpp>
#include <terrane/cli/reports/merge_report.hpp>
#include <terrane/cli/reports/seal_report.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/cli/session/text_width.hpp>
#include <terrane/cli/stages/plausibility.hpp>

namespace terrane::cli {
namespace {

constexpr unsigned most_rounds = 8;
constexpr std::size_t most_areas = 3;     ///< printed per surface
constexpr std::size_t most_surfaces = 40; ///< printed
constexpr std::size_t most_pairs = 20;    ///< printed

/// Numbers of one surface in the summary.
struct SurfaceTally {
    std::size_t triangles = 0; ///< of the output
    std::vector<double> areas; ///< of its regions
};

std::vector<SurfaceTally> tally(const RoundedMesh& rounded) {
    std::vector<SurfaceTally> tallies(rounded.mesh->surfaces.size());
    for (const auto s : rounded.mesh->surfaces_of.values) ++tallies[s].triangles;
    for (const Region& r : rounded.regions) tallies[r.surface].areas.push_back(r.area);
    for (auto& t : tallies) std::sort(t.areas.rbegin(), t.areas.rend());
    return tallies;
}

std::string areas_text(const std::vector<double>& areas) {
    std::string text;
    for (std::size_t i = 0; i < std::min(areas.size(), most_areas); ++i)
        text += fmt::format("{}{}", i > 0 ? ", " : "", figure(areas[i], 4));
    return areas.size() > most_areas ? text + ", ..." : text;
}

std::string surface_table(const Inputs& inputs, const Arranged& arranged) {
    constexpr std::string_view first = "surface"; // heading of the column of names
    const std::size_t width = column_width(inputs.labels, first.size());
    auto text = heading(fmt::format("  {}  {:>9}  {:>9}  {:>7}  areas of the regions{}",
                                    padded(first, width), "triangles", "-> output", "regions",
                                    inputs.unit.empty() ? "" : ", " + inputs.unit + "2")) +
                "\n";
    const auto tallies = tally(arranged.rounded);
    for (std::size_t s = 0; s < std::min(tallies.size(), most_surfaces); ++s)
        text += fmt::format("  {}  {:>9}  {:>9}  {:>7}  {}\n", padded(inputs.labels[s], width),
                            arranged.surfaces[s].triangles.size(), tallies[s].triangles,
                            tallies[s].areas.size(), areas_text(tallies[s].areas));
    if (tallies.size() > most_surfaces)
        text += fmt::format("  and {} more\n", tallies.size() - most_surfaces);
    return text;
}

std::string set_aside(const Arrangement& a) {
    if (a.degenerate.empty() && a.inputs.duplicates.empty()) return {};
    return fmt::format("set aside: {} without area, {} that repeat another\n",
                       counted(a.degenerate.size(), "triangle"), a.inputs.duplicates.size());
}

/// Returns the words before a number of contacts, if there may be more.
std::string_view at_least(std::size_t contacts) {
    return contacts > RoundingReport::most_counted ? "at least " : "";
}

std::string rounding_text(const RoundingReport& r, const Quantities& quantities) {
    std::string text = "doubles: every vertex is at its exact place";
    if (r.max_move > 0)
        text = fmt::format("doubles: no vertex is more than {} from its exact place",
                           quantities.length(r.max_move, 3));
    if (r.arranged_again)
        text += fmt::format(", where surfaces cross after they moved by up to {}",
                            quantities.length(r.surface_deviation, 3));
    if (r.rounds > 0)
        text += fmt::format("; {} of snapping, for {}{} that met improperly",
                            counted(r.rounds, "round"), at_least(r.naive_contacts),
                            counted(r.naive_contacts, "pair"));
    text += '\n';
    if (r.rounds > 0)
        text += fmt::format("doubles: no surface is more than {} from where it was, nor any of "
                            "its parts; {} is allowed\n",
                            quantities.length(r.surface_deviation, 3),
                            quantities.length(r.max_allowed, 3));
    if (r.vanished_length > 0)
        text += fmt::format("doubles: slivers that doubles can't hold vanished, which reached up "
                            "to {} beyond the rest\n",
                            quantities.length(r.vanished_length, 3));
    if (r.moved_input_vertices > 0)
        text += fmt::format("doubles: {} had to give way\n",
                            r.moved_input_vertices == 1
                                ? std::string("1 input vertex")
                                : fmt::format("{} input vertices", r.moved_input_vertices));
    if (!r.vanished.empty())
        text += fmt::format("doubles: {} vanished, thinner than the doubles\n",
                            counted(r.vanished.size(), "input triangle"));
    if (!r.vanished_regions.empty())
        text += fmt::format("doubles: {} fewer regions than in the exact result\n",
                            r.vanished_regions.size() == 1
                                ? std::string("1 surface has")
                                : fmt::format("{} surfaces have", r.vanished_regions.size()));
    text += r.clean ? good("verified:") + " the doubles are a conforming mesh, by exact check\n"
                    : fmt::format("{} {}{} of triangles still meet improperly, and no "
                                  "surface may move by more than {} to separate them\n",
                                  bad("NOT verified:"), at_least(r.contacts.size()),
                                  counted(r.contacts.size(), "pair"),
                                  quantities.length(r.max_allowed, 3));
    return text + text_of(r.pairs);
}

Point3 narrowed(const Point3& p) {
    const auto narrow = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return {narrow(p.x), narrow(p.y), narrow(p.z)};
}

/// Adds an option that is a positive number, or "auto".
void add_automatic(CLI::App& command, const std::string& name, double& value, bool& automatic,
                   const std::string& description) {
    command
        .add_option_function<std::string>(
            name,
            [name, &value, &automatic](const std::string& text) {
                automatic = text == "auto";
                if (automatic) return;
                const char* end = text.data() + text.size();
                const auto [at, failed] = std::from_chars(text.data(), end, value);
                if (failed != std::errc() || at != end || !(value > 0) || !std::isfinite(value))
                    throw CLI::ValidationError(name,
                                               "'" + text + "' is no positive number, nor auto");
            },
            description)
        ->type_name("D|auto");
}

constexpr const char* seal_option = "--seal";

/// Reads a distance for gaps: D, auto, or NAME=D for those of one surface or pair of surfaces.
void set_seal(const std::string& text, ArrangeSettings& settings) {
    const auto refuse = [](const std::string& sentence) {
        throw CLI::ValidationError(seal_option, sentence);
    };
    const auto is_good = [](double d) { return d >= 0 && std::isfinite(d); };
    double distance = 0;
    const char* end = text.data() + text.size();
    const auto [at, failed] = std::from_chars(text.data(), end, distance);
    const bool is_number = failed == std::errc() && at == end;
    if (text == "auto" || is_number) {
        if (is_number && !(is_good(distance) && distance > 0))
            refuse("'" + text + "' is no positive number");
        if (settings.seal != 0 || settings.seal_automatic)
            refuse("'" + text + "' is a second distance for all gaps");
        settings.seal_automatic = !is_number;
        settings.seal = is_number ? distance : 0;
        return;
    }
    const auto named = parse_named_length(text);
    if (!named) refuse("'" + text + "' is no positive number, nor auto, nor NAME=D");
    if (!is_good(named->length)) refuse("'" + text + "' has no distance, at least 0, behind =");
    settings.seal_of.push_back(*named);
}

void add_seal(CLI::App& command, ArrangeSettings& settings) {
    command
        .add_option_function<std::vector<std::string>>(
            seal_option,
            [&settings](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) set_seal(text, settings);
            },
            "Extend or trim free borders that end short of another surface, or beyond it, by "
            "at most this distance; every change is listed; auto: the last natural break in "
            "the widths of gaps; NAME=D: for the gaps of this surface; NAME/NAME=D: for those "
            "between these two; 0: they stay open; may be repeated (default: nothing moves)")
        ->allow_extra_args(false)
        ->type_name("[NAME=]D");
}

} // namespace

void add_settings(CLI::App& command, ArrangeSettings& settings) {
    static const std::map<std::string, Search> methods = [] {
        std::map<std::string, Search> all;
        for (const auto m : {Search::automatic, Search::grid, Search::ab, Search::ab_balanced,
                             Search::ab_median, Search::mixed, Search::bvh, Search::brute})
            all.emplace(name_of(m), m);
        return all;
    }();
    std::vector<std::string> words;
    for (const auto& [name, method] : methods) words.push_back(name);
    command
        .add_option("--search", settings.search,
                    "How triangles that may meet are found; the result is the same: "
                    "auto, grid, ab, ab-balanced, ab-median, mixed, hierarchy, brute (default: "
                    "auto)")
        ->transform(CLI::Transformer(methods, CLI::ignore_case).description(""))
        ->transform(listing(words)) // else numbers would be taken
        ->type_name("METHOD");
    command
        .add_option("--rounds", settings.rounds,
                    "Most rounds of snapping until the doubles are a conforming mesh; "
                    "0: only to the nearest double (default: 8)")
        ->check(CLI::Range(0U, most_rounds).description(""))
        ->type_name("N");
    add_max_move(command, settings.max_move);
    add_check(command, settings.check);
    add_seal(command, settings);
    add_automatic(command, "--min-volume", settings.min_volume, settings.min_volume_automatic,
                  "Merge smaller blocks with a neighbour, by removing what lies between; auto: a "
                  "cube of a tenth of the median edge length (default: none)");
    add_volume_options(command, settings.volume);
}

void add_statistics(Json& statistics, const Arranged& arranged, const Inputs& inputs) {
    if (arranged.extended) {
        add_statistics(statistics, *arranged.extended);
        add_constants(statistics, "extend", extension_constants());
    }
    if (arranged.choice) {
        add_statistics(statistics, *arranged.choice);
        add_constants(statistics, "seal_choice", seal_choice_constants());
    }
    if (arranged.sealed) {
        add_constants(statistics, "seal", seal_constants());
        add_statistics(statistics, *arranged.sealed, inputs);
    }
    add_statistics(statistics, arranged.exact);
    if (arranged.cut) {
        add_statistics(statistics, *arranged.cut, inputs);
        add_constants(statistics, "volume_of_interest", boundary_constants());
    }
    if (arranged.merged) {
        add_statistics(statistics, *arranged.merged, inputs);
        add_constants(statistics, "small_blocks", small_block_constants());
    }
    add_statistics(statistics, arranged.rounded);
}

Result<ArrangeWithinOptions> options_within(const ArrangeSettings& settings, const Inputs& inputs) {
    ArrangeWithinOptions options{.arrange = {.search = settings.search},
                                 .rounding = {.max_rounds = settings.rounds,
                                              .check = check_of(settings.check, inputs),
                                              .max_move = settings.max_move},
                                 .seal = settings.seal,
                                 .seal_automatic = settings.seal_automatic,
                                 .extend = settings.volume.extend,
                                 .min_volume = settings.min_volume_automatic
                                                   ? small_volume_for(inputs.surfaces)
                                                   : settings.min_volume};
    const auto infos = infos_of(inputs.surfaces);
    for (const auto& [name, distance] : settings.seal_of) {
        const auto rules = seal_rules_for(name, distance, infos, inputs.labels);
        if (!rules) return Error{ErrorCode::bad_option, rules.error().sentence, seal_option};
        options.seal_rules.insert(options.seal_rules.end(), rules->begin(), rules->end());
    }
    return options;
}

Status check_certifiable(const ArrangeSettings& settings) {
    if (settings.min_volume == 0 && !settings.min_volume_automatic) return Done{};
    return Error{ErrorCode::bad_option,
                 "a certificate can't show yet that only small blocks were merged; leave out "
                 "--min-volume, or the certificate",
                 "--certificate"};
}

Result<Arranged> arrange_and_round(Inputs& inputs, const ArrangeSettings& settings,
                                   Session& session, Json& statistics) {
    const auto options = options_within(settings, inputs);
    if (!options) return options.error();
    std::vector<Surface> boundary;
    if (settings.volume.wanted()) {
        auto made = boundary_of(settings.volume, session);
        if (!made) return made.error();
        boundary = std::move(made).value();
    }
    if (const auto sound = examine(inputs, {boundary, settings.blocks}, session, statistics);
        !sound)
        return sound.error();
    session.begin("arrange", Phase::computing);
    auto arranged =
        arrange_within(std::move(inputs.surfaces), std::move(boundary), *options, session.run());
    if (arranged) {
        inputs.labels = unique_labels(infos_of(arranged->surfaces));
        add_statistics(statistics, *arranged, inputs);
    }
    session.end_stage();
    return arranged;
}

std::string summary(const Inputs& inputs, const Arranged& arranged) {
    const Mesh& m = arranged.rounded.mesh;
    auto text = fmt::format("{}: {} -> {}, {}, {}\n", counted(arranged.surfaces.size(), "surface"),
                            counted(inputs.triangles, "triangle"), m.triangles.size(),
                            counted(m.intersection_edges.size(), "intersection edge"),
                            counted(arranged.rounded.regions.size(), "region"));
    text += surface_table(inputs, arranged);
    text += set_aside(arranged.exact);
    if (arranged.extended) text += text_of(*arranged.extended, inputs);
    if (arranged.choice) text += text_of(*arranged.choice, inputs);
    if (arranged.sealed) text += text_of(*arranged.sealed, inputs);
    if (arranged.cut) text += text_of(*arranged.cut, inputs);
    if (arranged.merged) text += text_of(*arranged.merged, inputs);
    text += rounding_text(arranged.rounded.report, inputs.quantities());
    return text;
}

std::string offending_pairs(const Inputs& inputs, const Arranged& arranged) {
    const auto& first = arranged.exact.inputs.first;
    const auto& contacts = arranged.rounded.report.contacts;
    const auto name = [&](std::uint32_t t) {
        const auto parents = arranged.rounded.mesh->parents_of[t];
        return fmt::format("output triangle {} (part of {})", t,
                           triangle_name(parents.front(), first, inputs.labels));
    };
    std::string text;
    for (std::size_t i = 0; i < std::min(most_pairs, contacts.size()); ++i) {
        const ImproperContact& c = contacts[i];
        text += fmt::format("  {} and {}: {} at {}\n", name(c.triangles[0]), name(c.triangles[1]),
                            name_of(c.kind), inputs.quantities().place(c.place));
    }
    if (contacts.size() > most_pairs)
        text += fmt::format("  and {}{} more\n", at_least(contacts.size()),
                            contacts.size() - most_pairs);
    return text;
}

Result<std::size_t> float32_flaws(const Mesh& mesh, const Run& run) {
    std::vector<Surface> one(1);
    for (const Point3& p : mesh.vertices) one[0].vertices.push_back(narrowed(p));
    one[0].triangles = mesh.triangles;
    const auto report = check(one, run);
    if (!report) return report.error();
    const CheckReport& r = report.value();
    return r.contacts.size() + r.degenerate.size() + r.repeated.size();
}

} // namespace terrane::cli
