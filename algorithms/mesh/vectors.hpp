// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Vectors in floating point, for measures only; exact signs are computed by the kernel's
// predicates.
#pragma once

#include <cmath>

#include <terrane/kernel/point.hpp>

namespace terrane {

inline Point3 minus(const Point3& a, const Point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const Point3& a, const Point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// Returns the length of a vector; intermediate results neither overflow nor underflow.
inline double length(const Point3& a) {
    const double square = dot(a, a);
    constexpr double least = 1e-290, most = 1e290; // results in between have lost no digits
    return square > least && square < most ? std::sqrt(square) : std::hypot(a.x, a.y, a.z);
}
/// Returns the length of a vector in a plane. It takes a tenth of the time of std::hypot().
inline double length_in_plane(double x, double y) {
    return length({x, y, 0});
}
inline Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace terrane
