// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Extents of surfaces, rounded: they serve warnings only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::plausibility::detail {

/// The box around the vertices that triangles use. Without triangles it is empty: low > high.
struct Extent {
    std::array<double, 3> low{inf, inf, inf};
    std::array<double, 3> high{-inf, -inf, -inf};

    static constexpr double inf = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool empty() const { return low[0] > high[0]; }
    [[nodiscard]] double size(std::size_t axis) const { return high[axis] - low[axis]; }
    [[nodiscard]] double middle(std::size_t axis) const {
        return std::midpoint(low[axis], high[axis]);
    }
    [[nodiscard]] double diagonal() const {
        return empty() ? 0
                       : distance_between({low[0], low[1], low[2]}, {high[0], high[1], high[2]});
    }

    void add(const Point3& p) {
        const std::array<double, 3> xyz{p.x, p.y, p.z};
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], xyz[i]);
            high[i] = std::max(high[i], xyz[i]);
        }
    }

    void add(const Extent& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], other.low[i]);
            high[i] = std::max(high[i], other.high[i]);
        }
    }
};

inline Extent extent_of(const Surface& surface) {
    Extent extent;
    for (const Triangle& t : surface.triangles)
        for (const auto v : t) extent.add(surface.vertices[v]);
    return extent;
}

inline Extent extent_of(std::span<const Extent> extents) {
    Extent all;
    for (const Extent& e : extents) all.add(e);
    return all;
}

/// Returns the gaps between two boxes along x and y; 0 where they meet. Larger boxes have no larger gaps, as
/// differences are rounded in order.
inline std::array<double, 2> gaps_from_above(const Extent& a, const Extent& b) {
    std::array<double, 2> gaps{};
    for (std::size_t i = 0; i < 2; ++i)
        gaps[i] = std::max({0.0, a.low[i] - b.high[i], b.low[i] - a.high[i]});
    return gaps;
}

/// Returns the length of the gap between two boxes seen from above; 0 where they meet.
inline double gap_from_above(const Extent& a, const Extent& b) {
    const auto [x, y] = gaps_from_above(a, b);
    return std::hypot(x, y);
}

/// Returns the length of the gap between two boxes; 0 where they meet.
inline double gap_between(const Extent& a, const Extent& b) {
    std::array<double, 3> gap{};
    for (std::size_t i = 0; i < 3; ++i)
        gap[i] = std::max({0.0, a.low[i] - b.high[i], b.low[i] - a.high[i]});
    return distance_between({}, {gap[0], gap[1], gap[2]});
}

} // namespace terrane::plausibility::detail
