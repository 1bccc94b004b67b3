// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The borders and creases of a surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane::tolerance::detail {

/// Two places, the lesser one first.
using EdgeEnds = std::array<Point3, 2>;

inline EdgeEnds ends_of(const Point3& a, const Point3& b) {
    return {std::min(a, b), std::max(a, b)};
}

/// Returns the vector of length 1, or zero.
inline Point3 unit(const Point3& p) {
    const double size = length(p);
    return size > 0 ? Point3{p.x / size, p.y / size, p.z / size} : Point3{};
}

/// Returns p + f q.
inline Point3 along(const Point3& p, double f, const Point3& q) {
    return {p.x + f * q.x, p.y + f * q.y, p.z + f * q.z};
}

/// Returns the unit normal of a triangle of a surface.
Point3 normal_of(const Surface& surface, std::uint32_t triangle);

/// An edge of a surface, by places.
struct SurfaceEdge {
    struct Side {
        std::uint32_t triangle;
        unsigned corner; ///< the edge runs from this one to the next
        bool forward;    ///< from the lesser place to the other
    };
    EdgeEnds ends{};
    std::vector<Side> sides{};
    bool is_crease = false; ///< or border: not of two triangles that meet at a small angle
};

/// Returns all edges with two distinct ends, ascending.
std::vector<SurfaceEdge> edges_of(const Surface& surface);

} // namespace terrane::tolerance::detail
