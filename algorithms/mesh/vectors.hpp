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
constexpr double least_square = 1e-290, most_square = 1e290; ///< in between none has lost digits

/// Returns the length of a vector; intermediate results neither overflow nor underflow.
inline double length(const Point3& a) {
    const double square = dot(a, a);
    return square > least_square && square < most_square ? std::sqrt(square)
                                                         : std::hypot(a.x, a.y, a.z);
}
/// Returns the length of a vector in a plane, as length() does, in a tenth of the time of hypot().
inline double length_in_plane(double x, double y) {
    const double square = x * x + y * y;
    return square > least_square && square < most_square ? std::sqrt(square) : std::hypot(x, y);
}
inline Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace terrane
