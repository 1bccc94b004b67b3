// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares heights of triangles in rationals, by clipping their projections along z.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include <terrane/kernel/point.hpp>

namespace oracles {

using terrane::Point3;

struct Exact2 {
    mpq_class x, y;
};

using Corners = std::array<Point3, 3>;

inline Exact2 flat(const Point3& p) {
    return {p.x, p.y};
}

inline mpq_class turn(const Exact2& a, const Exact2& b, const Exact2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Orders the corners counterclockwise in the projection; nothing for an upright triangle.
inline std::optional<Corners> upward(Corners c) {
    const mpq_class side = turn(flat(c[0]), flat(c[1]), flat(c[2]));
    if (side == 0) return std::nullopt;
    if (side < 0) std::swap(c[1], c[2]);
    return c;
}

/// Clips the projection of s by that of t. Both must be upward.
inline std::vector<Exact2> common(const Corners& s, const Corners& t) {
    std::vector<Exact2> polygon{flat(s[0]), flat(s[1]), flat(s[2])};
    for (unsigned i = 0; i < 3 && !polygon.empty(); ++i) {
        const Exact2 a = flat(t[i]), b = flat(t[(i + 1) % 3]);
        std::vector<Exact2> kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Exact2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
            const mpq_class u = turn(a, b, p), v = turn(a, b, q);
            if (u >= 0) kept.push_back(p);
            if (u * v < 0) {
                const mpq_class share = u / (u - v);
                kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
            }
        }
        polygon = kept;
    }
    return polygon;
}

/// Returns twice the area of a convex polygon.
inline mpq_class area(const std::vector<Exact2>& polygon) {
    mpq_class sum;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        sum += turn(polygon[0], polygon[k - 1], polygon[k]);
    return sum;
}

/// Returns the height of the plane of t, which must not be upright.
inline mpq_class height(const Corners& t, const Exact2& p) {
    const Exact2 a = flat(t[0]), b = flat(t[1]), c = flat(t[2]);
    return (turn(b, c, p) * mpq_class(t[0].z) + turn(c, a, p) * mpq_class(t[1].z) +
            turn(a, b, p) * mpq_class(t[2].z)) /
           turn(a, b, c);
}

} // namespace oracles
