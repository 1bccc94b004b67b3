// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Vertical lines and the triangles that they meet.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

/// Returns on which side of the line from a to b the point is in the map, moved a little to greater x, and less
/// to greater y; Zero only if a and b coincide in the map.
inline Sign shifted_side(const Point3& a, const Point3& b, const Point3& p) {
    if (const Sign sign = orient2d(Axis::z, a, b, p); sign != Sign::Zero) return sign;
    if (a.y != b.y) return a.y > b.y ? Sign::Positive : Sign::Negative;
    if (a.x == b.x) return Sign::Zero;
    return b.x > a.x ? Sign::Positive : Sign::Negative;
}

/// Tells whether the vertical through p, moved likewise, meets a triangle that turns so in the map.
inline bool shifted_meets(const std::array<Point3, 3>& t, Sign turn, const Point3& p) {
    return shifted_side(t[0], t[1], p) == turn && shifted_side(t[1], t[2], p) == turn &&
           shifted_side(t[2], t[0], p) == turn;
}

/// Tells whether the vertical through p meets a triangle that turns so in the map, or its border.
inline bool meets(const std::array<Point3, 3>& t, Sign turn, const Point3& p) {
    return orient2d(Axis::z, t[0], t[1], p) != -turn && orient2d(Axis::z, t[1], t[2], p) != -turn &&
           orient2d(Axis::z, t[2], t[0], p) != -turn;
}

/// Returns the height of the plane of a triangle at a place, within the heights of its corners.
inline double height_in_triangle(const std::array<Point3, 3>& t, const Point3& p) {
    const auto& [a, b, c] = t;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    const double to_b = ((p.x - a.x) * (c.y - a.y) - (c.x - a.x) * (p.y - a.y)) / area;
    const double to_c = ((b.x - a.x) * (p.y - a.y) - (p.x - a.x) * (b.y - a.y)) / area;
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    const double z = a.z + to_b * (b.z - a.z) + to_c * (c.z - a.z);
    return std::isfinite(z) ? std::clamp(z, low, high) : (low + high) / 2;
}

/// A point in which a vertical meets a triangle.
struct VerticalCrossing {
    std::size_t node = 0;
    double z = 0;
    std::uint32_t triangle = 0;
    std::uint32_t above = 0; ///< volume

    friend bool operator<(const VerticalCrossing& a, const VerticalCrossing& b) {
        if (a.node != b.node) return a.node < b.node;
        return a.z != b.z ? a.z < b.z : a.triangle < b.triangle;
    }
};

/// Returns where the verticals through the nodes, moved as shifted_side() says, meet triangles, sorted.
/// for_near(corners, visit) calls visit(node, place) for all nodes that may lie in the triangle in the map.
template <class ForNear>
std::vector<VerticalCrossing> vertical_crossings(const Mesh& mesh, const Volumes& volumes,
                                                 const ForNear& for_near) {
    std::vector<VerticalCrossing> found;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [i, j, k] = mesh.triangles[t];
        const std::array corners{mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
        const Sign turn = orient2d(Axis::z, corners[0], corners[1], corners[2]);
        if (turn == Sign::Zero) continue;
        const std::uint32_t above = volumes.of_sides[t][turn == Sign::Positive ? 0 : 1];
        for_near(corners, [&](std::size_t node, const Point3& p) {
            if (shifted_meets(corners, turn, p))
                found.push_back({node, height_in_triangle(corners, p), t, above});
        });
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace terrane
