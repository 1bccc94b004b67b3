// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lengths and areas of points whose differences, or products of these, are beyond the largest double.
#pragma once

#include <cmath>
#include <concepts>
#include <numeric>

#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {

/// Returns f(points), a measure of this dimension (1: a length, 2: an area). Where that is not finite, it is
/// computed from the points divided by a power of two: infinite only if the measure itself is beyond the
/// largest double, and a number unless f() has none for smaller points.
template <class F, std::same_as<Point3>... P>
double measure(int dimension, const F& f, const P&... points) {
    const double value = f(points...);
    if (std::isfinite(value)) return value;
    constexpr int halvings = 520; // products of two differences have an exponent below 1023
    const auto down = [](const Point3& p) {
        constexpr double factor = 0x1p-520;
        return Point3{p.x * factor, p.y * factor, p.z * factor};
    };
    return std::ldexp(f(down(points)...), dimension * halvings);
}

/// Returns the distance of two points.
inline double distance_between(const Point3& a, const Point3& b) {
    return measure(
        1,
        [](const Point3& p, const Point3& q) {
            return std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
        },
        a, b);
}

/// Returns the same by length(), which is faster and may differ in the last digit.
inline double length_between(const Point3& a, const Point3& b) {
    return measure(
        1, [](const Point3& p, const Point3& q) { return length(minus(q, p)); }, a, b);
}

/// Returns the middle of two points.
inline Point3 middle_of(const Point3& p, const Point3& q) {
    const auto middle = [](double a, double b) {
        const double m = a + (b - a) / 2;
        return std::isfinite(m) ? m : std::midpoint(a, b);
    };
    return {middle(p.x, q.x), middle(p.y, q.y), middle(p.z, q.z)};
}

/// Returns the centre of three points.
inline Point3 centre_of(const Point3& a, const Point3& b, const Point3& c) {
    const auto mean = [](double x, double y, double z) {
        const double m = (x + y + z) / 3;
        return std::isfinite(m) ? m : x / 3 + y / 3 + z / 3;
    };
    return {mean(a.x, b.x, c.x), mean(a.y, b.y, c.y), mean(a.z, b.z, c.z)};
}

/// Returns the area of a triangle.
inline double area_between(const Point3& a, const Point3& b, const Point3& c) {
    return measure(
        2,
        [](const Point3& p, const Point3& q, const Point3& r) {
            const Point3 n = cross(minus(q, p), minus(r, p));
            return std::hypot(n.x, n.y, n.z) / 2;
        },
        a, b, c);
}

} // namespace terrane
