// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/merge_report.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_merged = 20; ///< printed

std::string names_of(const MergedBlock& block, const Inputs& inputs) {
    std::string names;
    for (const std::uint32_t s : block.surfaces)
        names += (names.empty() ? "" : ", ") + inputs.labels[s];
    return names;
}

} // namespace

std::string text_of(const BlockMerge& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text = fmt::format("blocks below {}: {} merged with a neighbour\n",
                            quantities.volume(report.least, 4), report.merged.size());
    text += listed(report.merged, most_merged, [&](const MergedBlock& m) {
        return fmt::format("  volume {}, {} thick, at {}: {} of {} removed, area {}\n",
                           quantities.volume(m.volume, 4), quantities.length(m.thickness, 2),
                           quantities.place(m.place), counted(m.triangles, "triangle"),
                           names_of(m, inputs), quantities.area(m.area));
    });
    if (report.kept > 0)
        text += fmt::format("  {} kept, with no neighbour inside of the model\n", report.kept);
    return text;
}

void add_statistics(Json& json, const BlockMerge& report, const Inputs& inputs) {
    Json merged = Json::array();
    for (const MergedBlock& m : report.merged) {
        Json names = Json::array();
        for (const std::uint32_t s : m.surfaces) names.push_back(inputs.labels[s]);
        merged.push_back({{"volume", m.volume},
                          {"thickness", m.thickness},
                          {"into", std::isfinite(m.into) ? Json(m.into) : Json("outside")},
                          {"place", {m.place.x, m.place.y, m.place.z}},
                          {"surfaces", std::move(names)},
                          {"area", m.area},
                          {"triangles", m.triangles}});
    }
    json["small_blocks"] = {
        {"least_volume", report.least}, {"kept", report.kept}, {"merged", std::move(merged)}};
}

} // namespace terrane::cli
