// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include <terrane/algorithms/plausibility/detail/examination.hpp>
#include <terrane/algorithms/plausibility/detail/thresholds.hpp>

namespace terrane::plausibility::detail {
namespace {

using Groups = std::map<std::string, std::vector<std::uint32_t>>;

/// Returns "m (top, base) and ft (F1)".
std::string list_of(const Examination& e, const Groups& groups) {
    std::string text;
    std::size_t i = 0;
    for (const auto& [value, surfaces] : groups) {
        text += i == 0 ? "" : i + 1 == groups.size() ? " and " : ", ";
        text += fmt::format("{} ({})", value, e.names(surfaces));
        ++i;
    }
    return text;
}

/// Returns all surfaces but those of the largest group.
std::vector<std::uint32_t> odd_ones(const Groups& groups) {
    const auto largest =
        std::ranges::max_element(groups, {}, [](const auto& group) { return group.second.size(); });
    std::vector<std::uint32_t> odd;
    for (auto group = groups.begin(); group != groups.end(); ++group)
        if (group != largest) odd.insert(odd.end(), group->second.begin(), group->second.end());
    std::ranges::sort(odd);
    return odd;
}

void check_axes(Examination& e) {
    std::vector<std::uint32_t> mixed;
    for (const auto s : e.used) {
        const CoordinateFrame& frame = e.surfaces[s].frame;
        if (!frame.horizontal_unit.empty() && !frame.vertical_unit.empty() &&
            frame.horizontal_unit != frame.vertical_unit)
            mixed.push_back(s);
    }
    if (mixed.empty()) return;
    const CoordinateFrame& frame = e.surfaces[mixed.front()].frame;
    e.warn(Doubt::units_mixed, mixed,
           fmt::format("{} states {} for x and y, but {} for z", e.names(mixed),
                       frame.horizontal_unit, frame.vertical_unit),
           "Distances, areas and volumes then have no unit, and dips are wrong",
           "Convert while reading: --unit m, or another");
}

} // namespace

bool in_degrees(const Extent& extent) {
    return extent.low[0] >= -180 && extent.high[0] <= 360 && extent.low[1] >= -90 &&
           extent.high[1] <= 90 && extent.size(0) <= thresholds.most_degrees &&
           extent.size(1) <= thresholds.most_degrees;
}

void check_units(Examination& e) {
    check_axes(e);
    for (const bool vertical : {false, true}) {
        Groups groups;
        for (const auto s : e.used) {
            const CoordinateFrame& frame = e.surfaces[s].frame;
            const auto& unit = vertical ? frame.vertical_unit : frame.horizontal_unit;
            if (!unit.empty()) groups[unit].push_back(s);
        }
        if (groups.size() < 2) continue;
        e.warn(Doubt::units_mixed, odd_ones(groups),
               fmt::format("the files state different units for {}: {}", vertical ? "z" : "x and y",
                           list_of(e, groups)),
               "The numbers are taken as they are, so surfaces in one unit lie elsewhere and have "
               "another size",
               "Convert while reading: --unit m, or another");
        return;
    }
}

void check_systems(Examination& e) {
    Groups groups;
    std::vector<std::uint32_t> degrees, lengths;
    for (const auto s : e.used) {
        const auto& system = e.surfaces[s].frame.system;
        if (!system.empty()) groups[system].push_back(s);
        const Extent& extent = e.extents[s];
        const double largest = std::max({std::abs(extent.low[0]), std::abs(extent.high[0]),
                                         std::abs(extent.low[1]), std::abs(extent.high[1])});
        if (in_degrees(extent)) degrees.push_back(s);
        if (largest > thresholds.least_length) lengths.push_back(s);
    }
    constexpr auto answer = "Bring all files into one projected coordinate system first";
    if (groups.size() > 1)
        e.warn(Doubt::systems_mixed, odd_ones(groups),
               "the files state different coordinate systems: " + list_of(e, groups),
               "Coordinates of one system lie elsewhere in another", answer);
    else if (!degrees.empty() && !lengths.empty() &&
             degrees.size() + lengths.size() == e.used.size())
        e.warn(Doubt::systems_mixed, degrees,
               fmt::format("x and y of {} look like degrees, those of {} like lengths",
                           e.names(degrees), e.names(lengths)),
               "Surfaces in different coordinate systems never meet", answer);
}

} // namespace terrane::plausibility::detail
