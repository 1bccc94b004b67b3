// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/layer_report.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/reports/pair_report.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

std::string line_of(const std::string& label, const LayerReport& r, const Quantities& quantities) {
    if (r.dropped == 0) return fmt::format("  {}: nothing to replace\n", label);
    auto text = fmt::format("  {}: {} in {} replaced by {} of harder ones; area {} by {}; "
                            "moved by {} at most\n",
                            label, counted(r.dropped, "triangle"), counted(r.parts, "part"),
                            r.taken, quantities.area(r.dropped_area, 6),
                            quantities.area(r.taken_area, 6), quantities.length(r.largest_move));
    if (r.step_length > 0)
        text += fmt::format("  {}: harder ones end over or under it, which leaves steps along "
                            "{}\n",
                            label, quantities.length(r.step_length));
    return text;
}

} // namespace

void add_statistics(Json& json, const Inputs& inputs, const Layered& layered) {
    Json all = Json::array();
    for (const LayerReport& r : layered.reports)
        all.push_back({{"name", inputs.labels[r.surface]},
                       {"dropped", r.dropped},
                       {"taken", r.taken},
                       {"parts", r.parts},
                       {"dropped_area", r.dropped_area},
                       {"taken_area", r.taken_area},
                       {"largest_move", r.largest_move},
                       {"step_length", r.step_length}});
    json["layers"] = std::move(all);
    if (const auto& pairs = layered.rounded.report.pairs) json["rounding"]["pairs"] = *pairs;
    add_constants(json, "round", rounding_constants());
}

std::string text_of(const Inputs& inputs, const Layered& layered) {
    const auto& reports = layered.reports;
    auto text = counted(reports.size(), "layer") + ", from the top down:\n";
    for (const LayerReport& r : reports)
        text += line_of(inputs.labels[r.surface], r, inputs.quantities());
    const bool has_steps = std::any_of(reports.begin(), reports.end(),
                                       [](const LayerReport& r) { return r.step_length > 0; });
    if (layered.is_stack())
        text += fmt::format(
            "{} the doubles are a conforming mesh, and no layer is above one that is higher in "
            "the order{}, by exact checks\n",
            good("verified:"),
            has_steps ? fmt::format(" (except within {} of the lines of steps)",
                                    inputs.quantities().length(layered.step_width, 2))
                      : "");
    return text + text_of(layered.rounded.report.pairs);
}

std::string flaws_text(const Layered& layered) {
    const RoundingReport& report = layered.rounded.report;
    const auto& out_of_order = layered.out_of_order;
    if (report.clean && out_of_order.empty()) return {};
    if (report.clean)
        return complaint(fmt::format(
            "{} of triangles of layers are out of order in doubles, the first at {}, by {}",
            counted(out_of_order.size(), "pair"), place_text(out_of_order[0].place),
            figure(out_of_order[0].depth, 3)));
    return complaint(fmt::format("{} of triangles meet improperly in doubles, the first at {}",
                                 counted(report.contacts.size(), "pair"),
                                 place_text(report.contacts.at(0).place)));
}

} // namespace terrane::cli
