// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/detail/outline.hpp>

#include <algorithm>
#include <vector>

#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane::tetrahedra::detail {
namespace {

using static_filter::project, static_filter::Uv;

struct PolygonSide {
    std::size_t number = 0;
    Point3 from, to;
    double low_u = 0, high_u = 0, low_v = 0, high_v = 0;
};

/// Whether p, which is on the line of the side, is on the side.
bool on_side(Axis axis, const PolygonSide& side, const Point3& p) {
    const Uv from = project(axis, side.from), to = project(axis, side.to), at = project(axis, p);
    return std::min(from, to) <= at && at <= std::max(from, to);
}

/// Whether two sides have a common point.
bool meet(Axis axis, const PolygonSide& a, const PolygonSide& b) {
    const Sign b_from = orient2d(axis, a.from, a.to, b.from);
    const Sign b_to = orient2d(axis, a.from, a.to, b.to);
    const Sign a_from = orient2d(axis, b.from, b.to, a.from);
    const Sign a_to = orient2d(axis, b.from, b.to, a.to);
    if (b_from * b_to == Sign::Negative && a_from * a_to == Sign::Negative) return true;
    return (b_from == Sign::Zero && on_side(axis, a, b.from)) ||
           (b_to == Sign::Zero && on_side(axis, a, b.to)) ||
           (a_from == Sign::Zero && on_side(axis, b, a.from)) ||
           (a_to == Sign::Zero && on_side(axis, b, a.to));
}

/// Whether two consecutive sides have more than their common end.
bool fold(Axis axis, const PolygonSide& first, const PolygonSide& second) {
    if (orient2d(axis, first.from, first.to, second.to) != Sign::Zero) return false;
    const Uv a = project(axis, first.from), b = project(axis, first.to),
             c = project(axis, second.to);
    return (a < b) != (b < c);
}

} // namespace

std::optional<std::uint32_t> crossing_of(std::span<const std::uint32_t> corners,
                                         std::span<const Point3> points, Axis axis) {
    const std::size_t count = corners.size();
    std::vector<PolygonSide> sides(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 &from = points[corners[i]], &to = points[corners[(i + 1) % count]];
        const Uv a = project(axis, from), b = project(axis, to);
        sides[i] = {i,
                    from,
                    to,
                    std::min(a.u, b.u),
                    std::max(a.u, b.u),
                    std::min(a.v, b.v),
                    std::max(a.v, b.v)};
    }
    std::sort(sides.begin(), sides.end(),
              [](const PolygonSide& a, const PolygonSide& b) { return a.low_u < b.low_u; });
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count && sides[j].low_u <= sides[i].high_u; ++j) {
            const PolygonSide &a = sides[i], &b = sides[j];
            if (a.low_v > b.high_v || b.low_v > a.high_v) continue;
            const bool a_first = (a.number + 1) % count == b.number;
            const bool b_first = (b.number + 1) % count == a.number;
            if (a_first ? fold(axis, a, b) : b_first ? fold(axis, b, a) : meet(axis, a, b))
                return corners[a.number];
        }
    return std::nullopt;
}

} // namespace terrane::tetrahedra::detail
