// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/plausibility/detail/examination.hpp>
#include <terrane/algorithms/plausibility/detail/thresholds.hpp>

namespace terrane::plausibility::detail {
namespace {

/// Surfaces on one side of height 0, and the heights that they span.
struct Side {
    std::vector<std::uint32_t> surfaces;
    double low = Extent::inf, high = -Extent::inf;

    void add(std::uint32_t surface, const Extent& extent) {
        surfaces.push_back(surface);
        low = std::min(low, extent.low[2]);
        high = std::max(high, extent.high[2]);
    }
};

/// Tells whether the heights above 0 would lie at or near those below if they were depths.
bool would_fit_turned(const Side& above, const Side& below) {
    const double gap = std::max({0.0, -above.high - below.high, below.low + above.low});
    const double from_zero = std::min(above.low + above.high, -below.low - below.high) / 2;
    return gap < thresholds.turned_gap * from_zero;
}

/// Warns where each surface that is called a top is below each that is called a base.
void warn_of_tops_below_bases(Examination& e, const char* why) {
    std::vector<std::uint32_t> tops, bases;
    for (const auto s : e.used) {
        std::string name = e.surfaces[s].name.substr(0, 4);
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (name.starts_with("top")) tops.push_back(s);
        if (name == "base" || name == "bott") bases.push_back(s);
    }
    const auto is_below = [&](std::uint32_t top) {
        return std::ranges::all_of(bases, [&](std::uint32_t base) {
            return e.extents[top].middle(2) < e.extents[base].middle(2);
        });
    };
    if (tops.empty() || bases.empty() || !std::ranges::all_of(tops, is_below)) return;
    e.warn(Doubt::depths_unstated, e.used,
           fmt::format("{} is below {}, no file states the direction of z, and all z are positive",
                       e.names(tops), e.names(bases)),
           why, "If these are depths, read them with --depth");
}

} // namespace

// A topography above horizons is common, so opposite signs alone are no sign of a mistake: the two
// groups must be farther from each other than they are high, and fit once one is turned over.
void check_heights(Examination& e) {
    Side above, below;
    for (const auto s : e.used) {
        if (e.extents[s].low[2] > 0) above.add(s, e.extents[s]);
        if (e.extents[s].high[2] < 0) below.add(s, e.extents[s]);
    }
    if (above.surfaces.empty() || below.surfaces.empty() ||
        above.surfaces.size() + below.surfaces.size() != e.used.size())
        return;
    const double size = std::max(above.high - above.low, below.high - below.low);
    if (above.low - below.high <= thresholds.height_gap * size || !would_fit_turned(above, below))
        return;
    const bool above_is_odd = above.surfaces.size() <= below.surfaces.size();
    const Side& odd = above_is_odd ? above : below;
    const Side& rest = above_is_odd ? below : above;
    e.warn(
        Doubt::heights_mixed, odd.surfaces,
        fmt::format("z of {} is between {} and {}, that of all others between {} and "
                    "{}",
                    e.names(odd.surfaces), figure(odd.low), figure(odd.high), figure(rest.low),
                    figure(rest.high)),
        "If one of them counts depths downward, the surfaces lie on opposite sides of height 0 and "
        "never meet",
        "Read grids and points of depths with --depth; in GOCAD files, state ZPOSITIVE Depth");
}

void check_unstated_depths(Examination& e) {
    std::vector<std::uint32_t> columns, unstated, down;
    for (const auto s : e.used) {
        const CoordinateFrame& frame = e.surfaces[s].frame;
        const bool positive = e.extents[s].low[2] > 0;
        if (frame.column_of_depths && positive) columns.push_back(s);
        if (frame.vertical_axis == VerticalAxis::unstated && positive) unstated.push_back(s);
        if (frame.vertical_axis == VerticalAxis::down) down.push_back(s);
    }
    constexpr auto why = "Depths that are taken for heights turn the surface upside down";
    if (!columns.empty())
        e.warn(Doubt::depths_unstated, columns,
               fmt::format("z of {} is a column called depth, with positive values, and is read as "
                           "heights",
                           e.names(columns)),
               why, "Read it with --depth");
    else if (!down.empty() && !unstated.empty())
        e.warn(Doubt::depths_unstated, unstated,
               fmt::format(
                   "{} counts z downward and was turned over; {} does not state its direction, "
                   "is positive, and is read as heights",
                   e.names(down), e.names(unstated)),
               why, "If these are depths, read them with --depth");
    else if (unstated.size() == e.used.size())
        warn_of_tops_below_bases(e, why);
}

} // namespace terrane::plausibility::detail
