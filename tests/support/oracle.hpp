// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Exact answers that share no code with the kernel: points are homogeneous integers of GMP (doubles
// times a common power of two), predicates are determinants of homogeneous rows.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <gmpxx.h>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>

namespace oracle {

using terrane::Axis;
using terrane::Construction;
using terrane::Point3;
using terrane::Sign;
using Int = mpz_class;

/// A double as mantissa * 2^exponent, with an odd mantissa or 0.
struct Binary {
    std::int64_t mantissa = 0;
    int exponent = INT_MAX;

    explicit Binary(double d) {
        if (d == 0) return;
        int e = 0;
        mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(d, &e), 53));
        const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
        mantissa >>= zeros;
        exponent = e - 53 + zeros;
    }
};

inline int lowest_exponent(std::span<const Point3> points) {
    int lowest = INT_MAX;
    for (const Point3& p : points)
        for (const double d : {p.x, p.y, p.z}) lowest = std::min(lowest, Binary(d).exponent);
    return lowest == INT_MAX ? 0 : lowest;
}

/// Returns d / 2^exponent.
inline Int scaled(double d, int exponent) {
    const Binary b(d);
    Int i(static_cast<long>(b.mantissa));
    if (b.mantissa != 0) i <<= static_cast<mp_bitcnt_t>(b.exponent - exponent);
    return i;
}

/// The point (x, y, z) / w, times a power of two that is common to all points of a case; w > 0.
struct Point {
    Int x, y, z, w;
};

inline Point point(const Point3& p, int exponent) {
    return {scaled(p.x, exponent), scaled(p.y, exponent), scaled(p.z, exponent), 1};
}

inline std::vector<Point> points(std::span<const Point3> input) {
    const int exponent = lowest_exponent(input);
    std::vector<Point> result;
    for (const Point3& p : input) result.push_back(point(p, exponent));
    return result;
}

inline Sign sign(const Int& i) {
    return static_cast<Sign>(sgn(i));
}

using Row3 = std::array<Int, 3>;
using Row4 = std::array<Int, 4>;

inline Int determinant(const Row3& a, const Row3& b, const Row3& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Computes the determinant by complementary 2x2 minors (Laplace).
inline Int determinant(const Row4& a, const Row4& b, const Row4& c, const Row4& d) {
    const auto upper = [&](int i, int j) -> Int { return a[i] * b[j] - a[j] * b[i]; };
    const auto lower = [&](int i, int j) -> Int { return c[i] * d[j] - c[j] * d[i]; };
    return upper(0, 1) * lower(2, 3) - upper(0, 2) * lower(1, 3) + upper(0, 3) * lower(1, 2) +
           upper(1, 2) * lower(0, 3) - upper(1, 3) * lower(0, 2) + upper(2, 3) * lower(0, 1);
}

inline std::array<Int, 2> project(Axis axis, const Point& p) {
    if (axis == Axis::x) return {p.y, p.z};
    if (axis == Axis::y) return {p.z, p.x};
    return {p.x, p.y};
}

inline Sign orient3d(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto row = [](const Point& p) { return Row4{p.x, p.y, p.z, p.w}; };
    return -sign(determinant(row(a), row(b), row(c), row(d)));
}

inline Sign orient2d(Axis axis, const Point& a, const Point& b, const Point& c) {
    const auto row = [&](const Point& p) {
        const auto q = project(axis, p);
        return Row3{q[0], q[1], p.w};
    };
    return sign(determinant(row(a), row(b), row(c)));
}

inline Sign in_circle(Axis axis, const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto row = [&](const Point& p) {
        const auto q = project(axis, p);
        return Row4{q[0] * p.w, q[1] * p.w, q[0] * q[0] + q[1] * q[1], p.w * p.w};
    };
    return sign(determinant(row(a), row(b), row(c), row(d)));
}

/// Returns the turn from the direction a b to the direction c d, seen along an axis; w = 1.
inline Sign turn2d(Axis axis, const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto p = project(axis, a), q = project(axis, b), r = project(axis, c),
               s = project(axis, d);
    return sign((q[0] - p[0]) * (s[1] - r[1]) - (q[1] - p[1]) * (s[0] - r[0]));
}

/// Returns the coefficients (n, e) of the plane n x + e w = 0 through three points with w = 1.
inline Row4 plane(const Point& a, const Point& b, const Point& c) {
    const Row3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Row3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return {n[0], n[1], n[2], -(n[0] * a.x + n[1] * a.y + n[2] * a.z)};
}

/// Returns the plane through the line a b that is parallel to `axis`.
inline Row4 plane_along(Axis axis, const Point& a, const Point& b) {
    Point c = a;
    (axis == Axis::x ? c.x : axis == Axis::y ? c.y : c.z) += 1;
    return plane(a, b, c);
}

inline Int value(const Row4& plane, const Point& p) {
    return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3] * p.w;
}

inline Point with_positive_weight(Point p) {
    if (p.w < 0) p = {-p.x, -p.y, -p.z, -p.w};
    return p;
}

/// Returns the point on the line a b in the plane: each end is weighted by the value at the other.
inline Point meet(const Point& a, const Point& b, const Row4& plane) {
    const Int at_a = value(plane, a), at_b = value(plane, b);
    return with_positive_weight(
        {at_b * a.x - at_a * b.x, at_b * a.y - at_a * b.y, at_b * a.z - at_a * b.z, at_b - at_a});
}

/// Returns the common point of three planes by Cramer's rule.
inline Point meet(const Row4& a, const Row4& b, const Row4& c) {
    const auto minor = [&](int i, int j, int k) {
        return determinant(Row3{a[i], a[j], a[k]}, Row3{b[i], b[j], b[k]}, Row3{c[i], c[j], c[k]});
    };
    return with_positive_weight(
        {-minor(3, 1, 2), -minor(0, 3, 2), -minor(0, 1, 3), minor(0, 1, 2)});
}

/// Returns the point of a construction; w = 0 if it is undefined. `input` are all input points,
/// scaled.
inline Point construct(const Construction& how, const std::vector<Point>& input) {
    const auto at = [&](int i) -> const Point& { return input[how.v[static_cast<unsigned>(i)]]; };
    switch (how.kind) {
    case Construction::Kind::line_plane:
        return meet(at(0), at(1), plane(at(2), at(3), at(4)));
    case Construction::Kind::three_planes:
        return meet(plane(at(0), at(1), at(2)), plane(at(3), at(4), at(5)),
                    plane(at(6), at(7), at(8)));
    case Construction::Kind::line_line:
        return meet(at(0), at(1), plane_along(how.axis, at(2), at(3)));
    default:
        return at(0);
    }
}

/// Compares two points lexicographically; returns -1, 0 or 1.
inline int compare(const Point& p, const Point& q) {
    for (const auto coordinate : {&Point::x, &Point::y, &Point::z}) {
        const int c = cmp(p.*coordinate * q.w, q.*coordinate * p.w);
        if (c != 0) return c < 0 ? -1 : 1;
    }
    return 0;
}

/// Tells whether `result` is the double nearest to numerator / denominator * 2^exponent, with ties
/// to even, and infinite beyond the largest double. The denominator is > 0.
inline bool is_nearest(double result, const Int& numerator, const Int& denominator, int exponent) {
    constexpr double infinity = HUGE_VAL;
    if (std::isnan(result)) return false;
    // In units of 2^-1076, half of the smallest distance is still an integer.
    const auto units = [](double d, bool positive) -> Int {
        if (std::isinf(d)) return Int((positive ? Int(1) : Int(-1)) << (1024 + 1076));
        return scaled(d, -1076);
    };
    Int n = numerator, d = denominator;
    const int shift = exponent + 1076;
    if (shift > 0) n <<= static_cast<mp_bitcnt_t>(shift);
    if (shift < 0) d <<= static_cast<mp_bitcnt_t>(-shift);
    const double below = std::nextafter(result, -infinity),
                 above = std::nextafter(result, infinity);
    const Int here = units(result, result > 0);
    const bool even = std::isinf(result) || (std::bit_cast<std::uint64_t>(result) & 1) == 0;
    const auto within = [&](const Int& half_way_twice, int side) {
        // side * (n / d) <= side * half_way: equality only for even results
        const int c = cmp(Int(2 * n), Int(half_way_twice * d)) * side;
        return even ? c <= 0 : c < 0;
    };
    if (!(std::isinf(result) && result > 0) && !within(here + units(above, true), 1)) return false;
    if (!(std::isinf(result) && result < 0) && !within(here + units(below, false), -1))
        return false;
    return true;
}

} // namespace oracle
