// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/blocks.hpp>

#include <algorithm>
#include <map>
#include <span>

#include <fmt/format.h>

#include <terrane/algorithms/uncertainty/measures.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_listed_blocks = 50; ///< listed on the terminal
constexpr std::size_t most_leaks = 20;
constexpr std::size_t most_dangling = 40; ///< surfaces

std::string blocks_text(const Inputs& inputs, const Model& model) {
    const Quantities quantities = inputs.quantities();
    const auto& blocks = model.structure.blocks;
    const std::size_t count = model.block_count();
    auto text = fmt::format("{}, volume {} in all\n", counted(count, "closed block"),
                            quantities.volume(model.total_volume));
    for (std::size_t b = 1; b <= std::min(count, most_listed_blocks); ++b)
        text += fmt::format(
            "  block {:<4} volume {:<16} {}\n", b, quantities.volume(model.exact_volumes[b]),
            blocks[b].interfaces.empty() ? "(too thin for doubles)" : blocks[b].name);
    if (count > most_listed_blocks)
        text += fmt::format("  and {} more\n", count - most_listed_blocks);
    if (model.lost > 0)
        text +=
            fmt::format("doubles: {} too thin, and not written\n", counted(model.lost, "block"));
    if (model.made > 0)
        text += fmt::format("doubles: {} that the exact surfaces do not enclose\n",
                            counted(model.made, "block"));
    return text;
}

std::string structure_text(const Model& model) {
    const Structure& s = model.structure;
    std::map<LineKind, std::size_t> kinds;
    for (const ModelLine& line : s.lines) ++kinds[line.kind];
    std::string lines;
    for (const auto& [kind, count] : kinds)
        lines += fmt::format("{}{}", lines.empty() ? "" : ", ",
                             counted(count, std::string(name_of(kind))));
    return fmt::format("{}, {}, {}{}\n", counted(s.interfaces.size(), "interface"),
                       s.patches.size() == 1 ? "1 patch"
                                             : fmt::format("{} patches", s.patches.size()),
                       counted(s.corners.size(), "corner"), lines.empty() ? "" : ", " + lines);
}

/// Lists the surfaces of which a part has the same block on both sides.
std::string dangling_text(const Inputs& inputs, const Model& model) {
    std::vector<double> area(inputs.labels.size()), dangling(inputs.labels.size()),
        border(inputs.labels.size());
    const Quantities quantities = inputs.quantities();
    for (const ModelInterface& i : model.structure.interfaces)
        for (const std::uint32_t s : i.surfaces) {
            area[s] += i.area;
            if (i.dangles()) dangling[s] += i.area;
        }
    for (const FreeBorder& b : model.borders)
        for (const std::uint32_t s : b.surfaces) border[s] += b.length;
    std::string text;
    std::size_t count = 0;
    for (std::size_t s = 0; s < area.size(); ++s)
        if (dangling[s] > 0 && ++count <= most_dangling)
            text += fmt::format("  {}: {} of {} in area dangles, free border {}\n",
                                inputs.labels[s], quantities.area(dangling[s], 3),
                                quantities.area(area[s], 3), quantities.length(border[s], 3));
    if (count > most_dangling) text += fmt::format("  and {} more\n", count - most_dangling);
    return text.empty() ? "no surface dangles\n" : "surfaces that dangle:\n" + text;
}

std::string leak_lines(const Inputs& inputs, std::span<const Leak> leaks, const char* rest) {
    const Quantities quantities = inputs.quantities();
    return listed(
        leaks, most_leaks,
        [&](const Leak& l) {
            return fmt::format(
                "  {} ends by {}: along {}, {} apart, most at {}\n", inputs.labels[l.from],
                l.from == l.to ? "itself" : inputs.labels[l.to], quantities.length(l.length),
                quantities.lengths(l.least, l.largest, 2), quantities.place(l.place));
        },
        rest);
}

/// Lists the leaks that separate blocks, counts the harmless ones, and returns the others.
std::string judged_text(const Inputs& inputs, const LeakAdvice& advice, std::vector<Leak>& leaks) {
    const Quantities quantities = inputs.quantities();
    const auto distance = quantities.length(advice.distance, 6);
    auto text =
        advice.separating.empty()
            ? fmt::format("leaks: no gap of up to {} separates blocks\n", distance)
            : fmt::format("leaks: closing gaps of up to {} separates blocks where\n", distance) +
                  leak_lines(inputs, advice.separating, "");
    std::vector<Leak> others;
    std::size_t harmless = 0;
    double length = 0;
    for (std::size_t l = 0; l < leaks.size(); ++l) {
        if (advice.verdicts[l] == LeakVerdict::wide) others.push_back(leaks[l]);
        if (advice.verdicts[l] != LeakVerdict::harmless) continue;
        harmless += leaks[l].borders;
        length += leaks[l].length;
    }
    leaks = std::move(others);
    if (harmless > 0)
        text += fmt::format("harmless: {} as near to another surface, along {}\n",
                            counted(harmless, "border"), quantities.length(length));
    return text;
}

/// Lists where surfaces end near others: leaks that matter, then the others, the smallest gaps
/// first.
std::string leaks_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice) {
    auto leaks = leaks_of(model.borders);
    if (leaks.empty()) return {};
    std::string text;
    if (advice && advice->distance > 0) text = judged_text(inputs, *advice, leaks);
    if (leaks.empty()) return text;
    return text + "free borders, by the surface nearest to them and how far it is:\n" +
           leak_lines(inputs, leaks, ", farther apart");
}

} // namespace

void add_statistics(Json& json, const Model& model) {
    add_constants(json, "structure", structure_constants());
    json["output"]["volumes"] = model.block_count();
    Json volumes = Json::array();
    for (std::size_t b = 1; b < model.exact_volumes.size(); ++b)
        volumes.push_back(model.exact_volumes[b]);
    const Structure& s = model.structure;
    json["volumes"] = {{"all", model.total_volume},
                       {"blocks", volumes},
                       {"too_thin", model.lost},
                       {"made_by_rounding", model.made},
                       {"interfaces", s.interfaces.size()},
                       {"patches", s.patches.size()},
                       {"lines", s.lines.size()},
                       {"corners", s.corners.size()},
                       {"free_borders", model.borders.size()}};
}

std::string contacts_text(const Inputs& inputs, const Model& model,
                          const std::vector<double>& contacts, Json& statistics) {
    if (contacts.empty()) return {};
    const Quantities quantities = inputs.quantities();
    const auto measures = measure_blocks(model.mesh, model.volumes, contacts);
    const auto& blocks = model.structure.blocks;
    std::string text;
    Json all = Json::array();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        std::size_t count = 0;
        double volume = 0;
        std::string lines;
        Json parts = Json::array();
        for (std::size_t b = 1; b < measures.size(); ++b) {
            const PartAbove& part = measures[b].above[c];
            if (!(part.column > 0)) continue;
            volume += part.volume;
            parts.push_back({{"block", b},
                             {"volume", part.volume},
                             {"area", part.area},
                             {"column", part.column}});
            if (++count > most_listed_blocks) continue;
            lines += fmt::format("  block {:<4} volume {:<16} area {:<14} column {:<10} {}\n", b,
                                 quantities.volume(part.volume), quantities.area(part.area),
                                 quantities.length(part.column), blocks[b].name);
        }
        if (count > most_listed_blocks)
            lines += fmt::format("  and {} more\n", count - most_listed_blocks);
        text += fmt::format("above {}: volume {} in {}\n", quantities.length(contacts[c], 6),
                            quantities.volume(volume), counted(count, "block")) +
                lines;
        all.push_back({{"contact", contacts[c]}, {"volume", volume}, {"blocks", parts}});
    }
    statistics["contacts"] = std::move(all);
    return text;
}

std::optional<LeakAdvice> judge_leaks(const Arranged& arranged, const Model& model,
                                      Session& session) {
    if (arranged.sealed || model.borders.empty()) return std::nullopt;
    session.begin("leaks", Phase::computing);
    auto advice = judge_leaks(arranged, model.borders, {}, session.run());
    session.end_stage();
    return advice ? std::optional(*std::move(advice)) : std::nullopt;
}

std::string model_text(const Inputs& inputs, const Model& model,
                       const std::optional<LeakAdvice>& advice) {
    return blocks_text(inputs, model) + structure_text(model) + dangling_text(inputs, model) +
           leaks_text(inputs, model, advice);
}

} // namespace terrane::cli
