// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lengths, areas and distances in floating point, for forge_meaning.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::fuzz {

inline Point3 operator-(const Point3& a, const Point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point3 along(const Point3& from, const Point3& direction, double t) {
    return {from.x + t * direction.x, from.y + t * direction.y, from.z + t * direction.z};
}
inline double dot(const Point3& a, const Point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Point3& a) {
    return std::hypot(a.x, a.y, a.z);
}

inline std::array<Point3, 3> corners(const std::vector<Point3>& vertices, const Triangle& t) {
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}
/// A vector along the normal, whose length is the area.
inline Point3 area_vector(const std::array<Point3, 3>& t) {
    const Point3 twice = cross(t[1] - t[0], t[2] - t[0]);
    return {twice.x / 2, twice.y / 2, twice.z / 2};
}
inline double perimeter(const std::array<Point3, 3>& t) {
    return length(t[1] - t[0]) + length(t[2] - t[1]) + length(t[0] - t[2]);
}

inline double distance(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 along_side = b - a;
    const double square = dot(along_side, along_side);
    const double t = square > 0 ? std::clamp(dot(p - a, along_side) / square, 0.0, 1.0) : 0;
    return length(p - along(a, along_side, t));
}

/// Returns the distance of a point from a triangle. In doubles the plane of a thin triangle is known
/// worse than its sides, which are never nearer than the plane.
inline double distance(const Point3& p, const std::array<Point3, 3>& t) {
    const Point3 normal = cross(t[1] - t[0], t[2] - t[0]);
    bool inside = length(normal) > 0;
    for (std::size_t i = 0; i < 3; ++i)
        inside = inside && dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
    const double to_sides =
        std::min({distance(p, t[0], t[1]), distance(p, t[1], t[2]), distance(p, t[2], t[0])});
    return inside ? std::min(to_sides, std::abs(dot(p - t[0], normal)) / length(normal)) : to_sides;
}

} // namespace terrane::fuzz
