// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/seal_report.hpp>

#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_changes = 20; ///< printed

constexpr std::size_t most_open = 10; ///< printed

const char* sentence_for(OpenReason reason) {
    switch (reason) {
    case OpenReason::small_angle:
        return "the surfaces meet at too small an angle";
    case OpenReason::ends_beside:
        return "both surfaces end there, not in nearly one plane";
    case OpenReason::partly_farther:
        return "for part of the edge it is farther";
    case OpenReason::ends_free:
        return "the strip that would close it has a free end there";
    }
    return "";
}

/// Names the distances: "20 m", "20 m, F1/F2 10 m" or, by rules alone, "F1/F2 10 m".
std::string distances_text(const SealReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    std::string text = report.distance > 0 ? quantities.length(report.distance, 6) : "";
    for (const SealRule& rule : report.rules) {
        text += text.empty() ? "" : ", ";
        text += inputs.labels[rule.surface];
        if (rule.other) text += "/" + inputs.labels[*rule.other];
        text += " " + quantities.length(rule.distance, 6);
    }
    return text;
}

std::string open_text(const SealReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    return listed(report.open, most_open, [&](const OpenGap& gap) {
        return fmt::format(
            "  left open: {} by {} along {}, up to {} apart at {}: {}\n", inputs.labels[gap.from],
            gap.from == gap.to ? "itself" : inputs.labels[gap.to], quantities.length(gap.length),
            quantities.length(gap.width, 2), quantities.place(gap.place), sentence_for(gap.reason));
    });
}

} // namespace

std::string text_of(const SealReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    const auto distance = distances_text(report, inputs);
    if (report.changes.empty())
        return fmt::format("sealed by at most {}: no gap is so small\n", distance) +
               open_text(report, inputs);
    double length = 0;
    for (const SealChange& c : report.changes) length += c.length;
    auto text = fmt::format("sealed by at most {}: {}, along {}\n", distance,
                            counted(report.changes.size(), "change"), quantities.length(length));
    text += listed(report.changes, most_changes, [&](const SealChange& c) {
        return fmt::format("  {} {} along {}, by up to {} at {}: {} {}\n", inputs.labels[c.surface],
                           name_of(c.kind), quantities.length(c.length),
                           quantities.length(c.largest, 2), quantities.place(c.place),
                           counted(c.triangles, "triangle"),
                           c.kind == SealKind::extended ? "more" : "less");
    });
    if (report.left > 0)
        text += fmt::format("  free borders this near to another surface are left along {}\n",
                            quantities.length(report.left));
    return text + open_text(report, inputs);
}

std::string text_of(const SealChoice& choice, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text = fmt::format("gaps up to {}, a fifth of the median edge:\n",
                            quantities.length(choice.widest, 3));
    for (const GapBreak& b : choice.breaks)
        text += fmt::format("  {} of up to {}, along {}; next to none up to {}\n",
                            counted(b.gaps, "border edge"), quantities.length(b.low, 3),
                            quantities.length(b.length), quantities.length(b.high, 3));
    if (choice.breaks.empty()) return text + "  no natural break: nothing is sealed\n";
    return text + fmt::format("  chosen distance: {}\n", quantities.length(choice.distance, 6));
}

void add_statistics(Json& json, const SealChoice& choice) {
    json["seal_choice"] = choice;
}

std::string text_of(const SealAdvice& advice, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text = text_of(advice.choice, inputs);
    text += fmt::format("  {:>10}  {:>6}  {:>5}  {:>7}  {:>9}  {:>10}  {:>10}\n", "distance",
                        "blocks", "small", "changes", "triangles", "along", "left open");
    for (const SealTrial& t : advice.trials)
        text +=
            fmt::format("  {:>10}  {:>6}  {:>5}  {:>7}  {:>9}  {:>10}  {:>10}\n",
                        t.distance == 0 ? "none" : fmt::format("{}", t.distance), t.blocks, t.small,
                        t.changes, t.triangles, figure(t.length, 4), figure(t.left, 4));
    return text + fmt::format("small: below {}, see --min-volume auto; triangles: added or "
                              "removed; along: the borders that change\n",
                              quantities.volume(advice.small_volume, 3));
}

void add_statistics(Json& json, const SealAdvice& advice) {
    add_statistics(json, advice.choice);
    json["seal_trials"] = {{"small_volume", advice.small_volume}, {"trials", advice.trials}};
}

void add_statistics(Json& json, const SealReport& report, const Inputs& inputs) {
    Json entry{{"distance", report.distance},
               {"changes", report.changes},
               {"left", report.left},
               {"open", report.open}};
    if (!report.rules.empty()) entry["rules"] = report.rules;
    for (Json& change : entry["changes"])
        change["name"] = inputs.labels[change["surface"].get<std::size_t>()];
    for (Json& gap : entry["open"])
        gap["names"] = {inputs.labels[gap["from"].get<std::size_t>()],
                        inputs.labels[gap["to"].get<std::size_t>()]};
    if (entry.contains("rules"))
        for (Json& rule : entry["rules"]) {
            Json names = Json::array();
            for (const Json& s : rule["surfaces"])
                names.push_back(inputs.labels[s.get<std::size_t>()]);
            rule["names"] = std::move(names);
        }
    json["seal"] = std::move(entry);
}

} // namespace terrane::cli
