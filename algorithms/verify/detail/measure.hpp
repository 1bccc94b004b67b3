// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lengths and areas as files state them: to the last bit, by the same operations on all systems.
#pragma once

#include <algorithm>
#include <cmath>

#include <terrane/kernel/point.hpp>

namespace terrane::verifier {

/// Returns the vector from q to p.
inline Point3 vector_to(const Point3& p, const Point3& q) {
    return {p.x - q.x, p.y - q.y, p.z - q.z};
}

inline Point3 cross_product(const Point3& u, const Point3& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// Returns the length of a vector.
inline double length_of(const Point3& v) {
    const double most = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    if (most == 0) return 0;
    const double x = v.x / most, y = v.y / most, z = v.z / most;
    return most * std::sqrt(x * x + y * y + z * z);
}

/// Returns f(points...), a measure of this dimension; where it is beyond the largest double on the
/// way, that of smaller points, made larger again.
template <class F, class... Points>
double scaled(int dimension, const F& f, const Points&... points) {
    const double value = f(points...);
    if (std::isfinite(value)) return value;
    constexpr int halvings = 520;
    const auto small = [](const Point3& p) {
        return Point3{std::ldexp(p.x, -halvings), std::ldexp(p.y, -halvings),
                      std::ldexp(p.z, -halvings)};
    };
    return std::ldexp(f(small(points)...), dimension * halvings);
}

inline double distance_between(const Point3& a, const Point3& b) {
    const auto f = [](const Point3& p, const Point3& q) { return length_of(vector_to(q, p)); };
    return scaled(1, f, a, b);
}

/// Returns the area of a triangle.
inline double area_between(const Point3& a, const Point3& b, const Point3& c) {
    const auto f = [](const Point3& p, const Point3& q, const Point3& r) {
        return length_of(cross_product(vector_to(q, p), vector_to(r, p))) / 2;
    };
    return scaled(2, f, a, b, c);
}

} // namespace terrane::verifier
