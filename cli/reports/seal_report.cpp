// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/seal_report.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_changes = 20; ///< printed

const char* name_of(SealKind kind) {
    return kind == SealKind::extended ? "extended" : "trimmed";
}

} // namespace

std::string text_of(const SealReport& report, const Inputs& inputs) {
    if (report.changes.empty())
        return fmt::format("sealed by at most {}: no gap is so small\n", report.distance);
    double length = 0;
    for (const SealChange& c : report.changes) length += c.length;
    auto text = fmt::format("sealed by at most {}: {}, along {:.4g}\n", report.distance,
                            counted(report.changes.size(), "change"), length);
    for (std::size_t i = 0; i < std::min(report.changes.size(), most_changes); ++i) {
        const SealChange& c = report.changes[i];
        text += fmt::format("  {} {} along {:.4g}, by up to {:.2g} at {}: {} {}\n",
                            inputs.labels[c.surface], name_of(c.kind), c.length, c.largest,
                            text_of(c.place), counted(c.triangles, "triangle"),
                            c.kind == SealKind::extended ? "more" : "less");
    }
    if (report.changes.size() > most_changes)
        text += fmt::format("  and {} more\n", report.changes.size() - most_changes);
    if (report.left > 0)
        text += fmt::format("  free borders this near to another surface are left along {:.4g}\n",
                            report.left);
    return text;
}

Json json_of(const SealReport& report) {
    Json changes = Json::array();
    for (const SealChange& c : report.changes)
        changes.push_back({{"kind", name_of(c.kind)},
                           {"surface", std::uint32_t{c.surface}},
                           {"length", c.length},
                           {"distance", c.largest},
                           {"place", {c.place.x, c.place.y, c.place.z}},
                           {"triangles", c.triangles}});
    return {{"distance", report.distance}, {"changes", std::move(changes)}, {"left", report.left}};
}

void add_statistics(Json& json, const SealReport& report, const Inputs& inputs) {
    Json entry = json_of(report);
    for (Json& change : entry["changes"])
        change["name"] = inputs.labels[change["surface"].get<std::size_t>()];
    json["seal"] = std::move(entry);
}

} // namespace terrane::cli
