// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Vectors in floating point, for measures: exact signs come from the kernel's predicates.
#pragma once

#include <terrane/kernel/point.hpp>

namespace terrane {

inline Point3 minus(const Point3& a, const Point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const Point3& a, const Point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point3 cross(const Point3& a, const Point3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

} // namespace terrane
