// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/merge_report.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_printed = 20;

std::string names_of(std::span<const std::uint32_t> surfaces, const Inputs& inputs) {
    std::string names;
    for (const std::uint32_t s : surfaces) names += (names.empty() ? "" : ", ") + inputs.labels[s];
    return names;
}

Json labels_of(std::span<const std::uint32_t> surfaces, const Inputs& inputs) {
    Json names = Json::array();
    for (const std::uint32_t s : surfaces) names.push_back(inputs.labels[s]);
    return names;
}

} // namespace

std::string text_of(const BlockMerge& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text = fmt::format("blocks below {}: {} merged with a neighbour\n",
                            quantities.volume(report.least, 4), report.merged.size());
    text += listed(report.merged, most_printed, [&](const MergedBlock& m) {
        return fmt::format("  volume {}, {} thick, at {}: {} of {} removed, area {}\n",
                           quantities.volume(m.volume, 4), quantities.length(m.thickness, 2),
                           quantities.place(m.place), counted(m.triangles, "triangle"),
                           names_of(m.surfaces, inputs), quantities.area(m.area));
    });
    if (report.kept > 0)
        text += fmt::format("  {} kept, with no neighbour inside of the model\n", report.kept);
    return text;
}

void add_statistics(Json& json, const BlockMerge& report, const Inputs& inputs) {
    Json merged = Json::array();
    for (const MergedBlock& m : report.merged) {
        merged.push_back({{"volume", m.volume},
                          {"thickness", m.thickness},
                          {"into", std::isfinite(m.into) ? Json(m.into) : Json("outside")},
                          {"place", m.place},
                          {"surfaces", labels_of(m.surfaces, inputs)},
                          {"area", m.area},
                          {"triangles", m.triangles}});
    }
    json["small_blocks"] = {
        {"least_volume", report.least}, {"kept", report.kept}, {"merged", std::move(merged)}};
}

std::string text_of(const ToleranceReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text =
        fmt::format("joined within {}: {} of borders and creases, {} of {} in all\n",
                    quantities.length(report.tolerance, 4),
                    report.vertices == 1 ? "1 vertex" : fmt::format("{} vertices", report.vertices),
                    counted(report.cells, "thin cell"), quantities.volume(report.volume, 3));
    if (report.is_refused)
        text = fmt::format("nothing joined within {}: the moves are not shown to be within it\n",
                           quantities.length(report.tolerance, 4));
    for (const std::uint32_t s : report.vanished)
        text += fmt::format("  {} vanished: it is thinner, and the same as others now\n",
                            inputs.labels[s]);
    return text + listed(report.left, most_printed, [&](const ThinCell& cell) {
               return fmt::format("  left: {} thick, volume {}, at {}, between {}\n",
                                  quantities.length(cell.thickness, 2),
                                  quantities.volume(cell.volume, 3), quantities.place(cell.place),
                                  names_of(cell.surfaces, inputs));
           });
}

void add_statistics(Json& json, const ToleranceReport& report, const Inputs& inputs) {
    Json left = Json::array();
    for (const ThinCell& cell : report.left)
        left.push_back({{"thickness", cell.thickness},
                        {"volume", cell.volume},
                        {"place", cell.place},
                        {"surfaces", labels_of(cell.surfaces, inputs)}});
    json["tolerance"] = {{"tolerance", report.tolerance},
                         {"is_refused", report.is_refused},
                         {"vanished", labels_of(report.vanished, inputs)},
                         {"vertices", report.vertices},
                         {"cells", report.cells},
                         {"volume", report.volume},
                         {"left", std::move(left)}};
}

} // namespace terrane::cli
