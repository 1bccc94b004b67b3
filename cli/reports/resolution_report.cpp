// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/resolution_report.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/quantities.hpp>
#include <terrane/cli/session/styles.hpp>
#include <terrane/io/report_members.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_lines = 20; ///< printed of each kind

std::string block_name(std::uint32_t block) {
    return block == 0 ? std::string("the outside") : fmt::format("block {}", block);
}

std::string change_of(const ChangedBlock& change, const Quantities& quantities) {
    const auto volume = quantities.volume(change.volume, 4);
    if (change.parts > 0)
        return fmt::format("  {}, {}: now {} blocks\n", block_name(change.block), volume,
                           change.parts);
    if (change.into == change.block)
        return fmt::format("  block {}, {}: gone\n", change.block, volume);
    return fmt::format("  block {}, {}: gone, most of its sides are at {} now\n", change.block,
                       volume, block_name(change.into));
}

std::string reasons_of(const SimplifyReport& report) {
    std::map<LeftReason, std::size_t> counts;
    for (const LeftAlone& left : report.left) ++counts[left.reason];
    std::string text;
    for (const auto& [reason, count] : counts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(reason));
    return text;
}

std::string contacts_text(const SimplifyReport& report, const Inputs& inputs) {
    const auto verb = [](const ChangedContact& c) {
        return c.is_new ? "touch now" : "touch no more";
    };
    auto text = listed(report.block_contacts, most_lines, [&](const ChangedContact& c) {
        return fmt::format("  {} and {} {}\n", block_name(c.between[0]), block_name(c.between[1]),
                           verb(c));
    });
    return text + listed(report.surface_contacts, most_lines, [&](const ChangedContact& c) {
               return fmt::format("  {} and {} {}\n", inputs.labels[c.between[0]],
                                  inputs.labels[c.between[1]], verb(c));
           });
}

} // namespace

std::string text_of(const SimplifyReport& report, const Inputs& inputs) {
    const Quantities quantities = inputs.quantities();
    auto text = fmt::format(
        "resolution {}: {} joined, {} of curves and {} of surfaces zipped, {} divided\n",
        quantities.length(report.resolution), counted(report.corners, "corner"),
        counted(report.curves, "place"), report.sheets, counted(report.divided, "edge"));
    double out = 0, back = 0;
    for (const Deviation& d : report.deviations) {
        out = std::max(out, d.out);
        back = std::max(back, d.back);
    }
    text += fmt::format("  {}: moved by at most {}, measured {} from new to old and {} from old to "
                        "new\n",
                        report.is_shown ? good("verified") : bad("NOT verified"),
                        quantities.length(report.max_move), quantities.length(out),
                        quantities.length(back));
    text += listed(report.blocks, most_lines,
                   [&](const ChangedBlock& change) { return change_of(change, quantities); });
    text += contacts_text(report, inputs);
    for (const std::uint32_t s : report.vanished)
        text += fmt::format("  {} vanished: nothing of it is left\n", inputs.labels[s]);
    for (const std::uint32_t b : report.kept)
        text += fmt::format("  {} is thin, or would change, and was kept\n", block_name(b));
    if (report.left.empty()) return text;
    text += fmt::format("  left alone: {} ({})\n", counted(report.left.size(), "place"),
                        reasons_of(report));
    return text + listed(report.left, most_lines, [&](const LeftAlone& left) {
               return fmt::format("    {} apart at {}: {}\n", quantities.length(left.distance, 3),
                                  quantities.place(left.place), name_of(left.reason));
           });
}

std::string resolution_text(Json& json, const Arranged& arranged, const Inputs& inputs) {
    if (!arranged.simplified) return {};
    add_statistics(json, arranged.simplified->report, inputs);
    add_constants(json, "resolution", simplify_constants());
    return text_of(arranged.simplified->report, inputs);
}

void add_statistics(Json& json, const SimplifyReport& report, const Inputs& inputs) {
    Json contacts = Json::array(), deviations = Json::object(), vanished = Json::array();
    for (const ChangedContact& c : report.block_contacts)
        contacts.push_back({{"blocks", c.between}, {"new", c.is_new}});
    for (const ChangedContact& c : report.surface_contacts)
        contacts.push_back(
            {{"surfaces", {inputs.labels[c.between[0]], inputs.labels[c.between[1]]}},
             {"new", c.is_new}});
    for (std::size_t s = 0; s < report.deviations.size(); ++s)
        deviations[inputs.labels[s]] = {report.deviations[s].out, report.deviations[s].back};
    for (const std::uint32_t s : report.vanished) {
        vanished.push_back(inputs.labels[s]);
        deviations.erase(inputs.labels[s]);
    }
    Json entry = report;
    entry["verified"] = report.is_shown;
    entry["deviation"] = std::move(deviations);
    entry["blocks"] = report.blocks;
    entry["contacts"] = std::move(contacts);
    entry["vanished"] = std::move(vanished);
    entry["kept_blocks"] = report.kept;
    entry["left_alone"] = report.left;
    json["resolution"] = std::move(entry);
}

} // namespace terrane::cli
