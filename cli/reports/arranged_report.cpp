// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/arranged_report.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/cli/options/volume_options.hpp>
#include <terrane/cli/reports/merge_report.hpp>
#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/reports/seal_report.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/cli/session/text_width.hpp>

namespace terrane::cli {
namespace {

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
std::string_view at_least(bool may_be_more) {
    return may_be_more ? "at least " : "";
}

Point3 narrowed(const Point3& p) {
    const auto narrow = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    return {narrow(p.x), narrow(p.y), narrow(p.z)};
}

} // namespace

std::string text_of(const RoundingReport& r, const Quantities& quantities) {
    std::string text = "doubles: every vertex is at its exact place";
    if (r.max_move > 0)
        text = fmt::format("doubles: no vertex is more than {} from its exact place",
                           quantities.length(r.max_move, 3));
    if (r.arranged_again)
        text += fmt::format(", where surfaces cross after they moved by up to {}",
                            quantities.length(r.surface_deviation, 3));
    if (r.rounds > 0)
        text += fmt::format("; {} of snapping, for {}{} that met improperly",
                            counted(r.rounds, "round"),
                            at_least(r.naive_contacts >= RoundingReport::least_sampled),
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
                                  bad("NOT verified:"),
                                  at_least(r.contacts.size() > RoundingReport::most_counted),
                                  counted(r.contacts.size(), "pair"),
                                  quantities.length(r.max_allowed, 3));
    if (r.sufficient_limit > 0) text += fmt::format("--max-move {} would do\n", r.sufficient_limit);
    return text + text_of(r.pairs);
}

void add_statistics(Json& statistics, const Arranged& arranged, const Inputs& inputs) {
    if (arranged.extended) {
        add_statistics(statistics, *arranged.extended);
        add_constants(statistics, "extend", extension_constants());
    }
    if (arranged.joined) {
        add_statistics(statistics, *arranged.joined, inputs);
        add_constants(statistics, "tolerance", tolerance_constants());
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

std::string summary(const Inputs& inputs, const Arranged& arranged) {
    const Mesh& m = arranged.rounded.mesh;
    auto text = fmt::format("{}: {} -> {}, {}, {}\n", counted(arranged.surfaces.size(), "surface"),
                            counted(inputs.triangles, "triangle"), m.triangles.size(),
                            counted(m.intersection_edges.size(), "intersection edge"),
                            counted(arranged.rounded.regions.size(), "region"));
    text += surface_table(inputs, arranged);
    text += set_aside(arranged.exact);
    if (arranged.joined) text += text_of(*arranged.joined, inputs);
    if (arranged.extended) text += text_of(*arranged.extended, inputs);
    if (arranged.choice) text += text_of(*arranged.choice, inputs);
    if (arranged.sealed) text += text_of(*arranged.sealed, inputs);
    if (arranged.cut) text += text_of(*arranged.cut, inputs);
    if (arranged.merged) text += text_of(*arranged.merged, inputs);
    text += text_of(arranged.rounded.report, inputs.quantities());
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
        text += fmt::format("  and {}{} more\n",
                            at_least(contacts.size() > RoundingReport::most_counted),
                            contacts.size() - most_pairs);
    return text;
}

std::size_t float32_flaws(const Mesh& mesh, const Run& run) {
    std::vector<Surface> one(1);
    for (const Point3& p : mesh.vertices) one[0].vertices.push_back(narrowed(p));
    one[0].triangles = mesh.triangles;
    const CheckReport r = must(check(one, run));
    return r.contacts.size() + r.degenerate.size() + r.repeated.size();
}

} // namespace terrane::cli
