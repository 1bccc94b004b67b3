// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sealing/detail/open_gaps.hpp>

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/sealing/detail/constants.hpp>

namespace terrane::sealing::detail {
namespace {

/// A gap that stays open, and why.
struct Left {
    Gap gap{};
    OpenReason reason{};
};

OpenReason reason_for(const FacingBorders& borders, const GapDistances& distances, std::uint32_t e,
                      const Gap& gap) {
    const auto near = distances.nearest(gap.place, gap.edge);
    if (!near) return OpenReason::ends_free;
    const auto facing = borders.facing(e);
    if (facing && borders.edges()[facing->edge].surface == SurfaceId(near->surface))
        return borders.facing(facing->edge) ? OpenReason::ends_free : OpenReason::partly_farther;
    const Point3 way = minus(near->place, gap.place);
    const double distance = length(way);
    if (borders.is_border_nearest(gap.place, near->surface, distance))
        return OpenReason::ends_beside;
    return std::fabs(dot(borders.outward(e), way)) < constants.most_flat * distance
               ? OpenReason::small_angle
               : OpenReason::ends_free;
}

/// Returns what an edge faces on the border of its own surface.
std::optional<Left> own_border(const FacingBorders& borders, std::uint32_t e) {
    const auto facing = borders.facing(e);
    const BorderEdge& edge = borders.edges()[e];
    if (!facing || borders.edges()[facing->edge].surface != edge.surface) return std::nullopt;
    const double size = borders.length_of(e);
    return Left{{edge, size, facing->distance, facing->place, edge.surface},
                borders.facing(facing->edge) ? OpenReason::ends_free : OpenReason::partly_farther};
}

std::optional<Left> left_at(const FacingBorders& borders, const GapDistances& distances,
                            std::uint32_t e) {
    const BorderEdge& edge = borders.edges()[e];
    if (const auto gap = distances.gap_at(edge))
        return Left{*gap, reason_for(borders, distances, e, *gap)};
    if (auto left = own_border(borders, e)) return left;
    if (const auto gap = gap_to_own(borders, distances, e))
        return Left{*gap, OpenReason::ends_free};
    if (const auto gap = distances.part_gap_at(edge)) return Left{*gap, OpenReason::partly_farther};
    return std::nullopt;
}

} // namespace

std::optional<Gap> gap_to_own(const FacingBorders& borders, const GapDistances& distances,
                              std::uint32_t e) {
    const BorderEdge& edge = borders.edges()[e];
    const Point3 middle = borders.middle_of(e);
    const auto near = distances.nearest_own(middle, edge);
    if (!near ||
        borders.is_border_nearest(middle, edge.surface, length(minus(near->place, middle)), edge))
        return std::nullopt;
    return distances.own_gap_at(edge);
}

std::vector<OpenGap> list_open_gaps(const FacingBorders& borders, const GapDistances& distances) {
    std::map<std::tuple<SurfaceId, SurfaceId, OpenReason>, OpenGap> all;
    for (std::uint32_t e = 0; e < borders.edges().size(); ++e) {
        const auto left = left_at(borders, distances, e);
        if (!left) continue;
        const Gap& gap = left->gap;
        const SurfaceId from = borders.edges()[e].surface, to(gap.to);
        OpenGap& open = all[{from, to, left->reason}];
        open.from = from;
        open.to = to;
        open.reason = left->reason;
        ++open.edges;
        open.length += gap.length;
        if (gap.largest < open.width || (gap.largest == open.width && open.place < gap.place))
            continue;
        open.width = gap.largest;
        open.place = gap.place;
    }
    std::vector<OpenGap> list;
    for (const auto& [key, open] : all) list.push_back(open);
    return list;
}

} // namespace terrane::sealing::detail
