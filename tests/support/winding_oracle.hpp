// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Winding numbers of points by rays, in rationals.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include <gmpxx.h>

#include <terrane/algorithms/mesh/surface.hpp>

namespace test_support {

using RationalPoint = std::array<mpq_class, 3>;

inline RationalPoint between(const terrane::Point3& p, const RationalPoint& q) {
    return {mpq_class(p.x) - q[0], mpq_class(p.y) - q[1], mpq_class(p.z) - q[2]};
}

inline mpq_class determinant(const RationalPoint& a, const RationalPoint& b,
                             const RationalPoint& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Returns how often triangles wind around a point, counted along a ray; nothing if the ray meets an edge or the
/// point lies in the plane of a triangle that the ray's line meets.
template <class Vertices, class Triangles>
std::optional<int> winding_along(const Vertices& vertices, const Triangles& triangles,
                                 const RationalPoint& q, const RationalPoint& ray) {
    int winding = 0;
    for (const terrane::Triangle& t : triangles) {
        const RationalPoint a = between(vertices[t[0]], q), b = between(vertices[t[1]], q),
                            c = between(vertices[t[2]], q);
        const std::array<mpq_class, 3> turns{determinant(ray, a, b), determinant(ray, b, c),
                                             determinant(ray, c, a)};
        const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
        if (*least < 0 && *most > 0) continue;
        if (*least == 0 && *most == 0) { // the ray lies in the plane, or the triangle has no area
            if (determinant(a, b, c) == 0) return std::nullopt;
            continue;
        }
        const int side = *most > 0 ? 1 : -1; // the ray leaves through the front, or the back
        const mpq_class ahead = determinant(a, b, c) * side;
        if (ahead == 0) return std::nullopt;
        if (ahead < 0) continue;
        if (std::count(turns.begin(), turns.end(), 0) > 0) return std::nullopt;
        winding += side;
    }
    return winding;
}

/// Returns the winding number of a point; nothing if none of some rays decides it.
template <class Vertices, class Triangles>
std::optional<int> winding_around(const Vertices& vertices, const Triangles& triangles,
                                  const RationalPoint& q) {
    for (const std::array<int, 3>& d : {std::array{1009, 887, 613}, std::array{-311, 757, 1013},
                                        std::array{523, -997, 211}, std::array{-89, -631, -1019}})
        if (const auto found = winding_along(vertices, triangles, q, {d[0], d[1], d[2]}))
            return found;
    return std::nullopt;
}

} // namespace test_support
