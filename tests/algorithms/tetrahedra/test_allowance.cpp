// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The allowance against rational arithmetic: statements (1) and (4) of tetrahedra.md.
#include <terrane/algorithms/tetrahedra/allowance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/effort.hpp"
#include "support/points.hpp"
#include <terrane/kernel/predicates.hpp>

using namespace terrane;
using namespace terrane::tetrahedra;
using namespace test_support;

namespace {

using Rational = mpq_class;
using Rational3 = std::array<Rational, 3>;

std::array<double, 3> array_of(const Point3& p) {
    return {p.x, p.y, p.z};
}

Rational3 exact(const Point3& p) {
    return {Rational(p.x), Rational(p.y), Rational(p.z)};
}

Rational3 minus(const Rational3& a, const Rational3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Clips the parameters of the edge, coordinate by coordinate, as long as some are left.
bool near_edge_in_rationals(const Point3& p, const Point3& a, const Point3& b) {
    const Rational3 from = exact(a), d = minus(exact(b), from), q = minus(exact(p), from);
    const auto e = array_of(allowance(a, b));
    Rational low = 0, high = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        if (d[i] == 0) {
            if (abs(q[i]) > Rational(e[i])) return false;
            continue;
        }
        const Rational first = (q[i] - e[i]) / d[i], last = (q[i] + e[i]) / d[i];
        low = std::max(low, std::min(first, last));
        high = std::min(high, std::max(first, last));
    }
    return low <= high;
}

/// Tries the corner of the box of allowances that goes farthest towards the plane.
bool near_plane_in_rationals(const Point3& p, const std::array<Point3, 3>& t) {
    const Rational3 a = exact(t[0]), u = minus(exact(t[1]), a), w = minus(exact(t[2]), a);
    const auto e = array_of(allowance(t));
    Rational3 q = minus(exact(p), a), n;
    for (std::size_t i = 0; i < 3; ++i)
        n[i] = u[(i + 1) % 3] * w[(i + 2) % 3] - u[(i + 2) % 3] * w[(i + 1) % 3];
    const Rational before = n[0] * q[0] + n[1] * q[1] + n[2] * q[2];
    for (std::size_t i = 0; i < 3; ++i) q[i] -= e[i] * sgn(n[i]) * sgn(before);
    const Rational after = n[0] * q[0] + n[1] * q[1] + n[2] * q[2];
    return sgn(after) * sgn(before) <= 0;
}

/// a + s (b - a) + t (c - a), in doubles.
Point3 between(const std::array<Point3, 3>& corners, double s, double t) {
    const auto& [a, b, c] = corners;
    return {a.x + s * (b.x - a.x) + t * (c.x - a.x), a.y + s * (b.y - a.y) + t * (c.y - a.y),
            a.z + s * (b.z - a.z) + t * (c.z - a.z)};
}

/// A triangle of any size and place.
std::array<Point3, 3> random_triangle(Random& random) {
    const double scale = std::ldexp(1.0, random_int(random, -20, 20));
    const double away = random_int(random, 0, 2) == 0 ? 0 : random_real(random, -4, 4) * scale;
    std::array<Point3, 3> corners;
    for (Point3& p : corners) {
        const auto number = [&] { return away + scale * random_real(random, -1, 1); };
        p = {number(), number(), number()};
    }
    if (random_int(random, 0, 3) == 0) // in a plane of a coordinate
        for (Point3& p : corners) p.z = corners[0].z;
    return corners;
}

double moved(Random& random, double x, double spacing) {
    return x + random_int(random, -8, 8) * spacing;
}

} // namespace

TEST_CASE("allowance: spacings are those of doubles", "[tetrahedra]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {1.0, 1.5, 0x1.fffffffffffffp+0, 2.0, 1e300, 3e-308, 0x1p-1022, 5e5})
        for (const double sign : {1.0, -1.0})
            CHECK(spacing_at(sign * x) == std::nextafter(x, infinity) - x);
    for (const double x : {0.0, 1e-310, 0x1p-1074}) CHECK(spacing_at(x) == 0x1p-1074);
    const Point3 e = allowance({1, -3, 0}, {-1.5, 2, 0});
    CHECK(e == Point3{5 * 0x1p-52, 5 * 0x1p-51, 5 * 0x1p-1074});
}

TEST_CASE("allowance: points computed in doubles are within five spacings of the triangle",
          "[tetrahedra]") {
    Random random(1);
    Rational largest = 0;
    for (int i = 0; i < cases(20000); ++i) {
        const auto corners = random_triangle(random);
        double s = random_real(random, 0, 1), t = random_real(random, 0, 1);
        if (s + t > 1 || Rational(s) + Rational(t) > 1) s /= 2, t /= 2;
        const auto p = array_of(between(corners, s, t));
        const Rational3 a = exact(corners[0]), u = minus(exact(corners[1]), a),
                        w = minus(exact(corners[2]), a);
        const auto e = array_of(allowance(corners));
        for (std::size_t k = 0; k < 3; ++k) {
            const Rational off = abs(Rational(p[k]) - a[k] - s * u[k] - t * w[k]) / Rational(e[k]);
            largest = std::max(largest, off);
        }
        REQUIRE(largest <= 1);
    }
    CHECK(largest > Rational(1, 5)); // more than rounding one point costs
}

TEST_CASE("allowance: near an edge, judged by rationals", "[tetrahedra]") {
    Random random(2);
    int near = 0, far = 0;
    for (int i = 0; i < cases(20000); ++i) {
        const auto corners = random_triangle(random);
        Point3 p = between(corners, random_real(random, -1e-15, 1), 0);
        const Point3 h = allowance(corners[0], corners[1]);
        p = {moved(random, p.x, h.x / 5), moved(random, p.y, h.y / 5), moved(random, p.z, h.z / 5)};
        const bool expected = near_edge_in_rationals(p, corners[0], corners[1]);
        ++(expected ? near : far);
        REQUIRE(near_edge(p, corners[0], corners[1]) == expected);
        REQUIRE(near_edge(p, corners[1], corners[0]) == expected);
    }
    CHECK(near > cases(20000) / 10);
    CHECK(far > cases(20000) / 10);
    CHECK_FALSE(near_edge({1 + 6 * 0x1p-52, 0, 0}, {0, 0, 0}, {1, 0, 0})); // beyond the end
    CHECK(near_edge({1 + 5 * 0x1p-52, 0, 0}, {0, 0, 0}, {1, 0, 0}));
}

TEST_CASE("allowance: near a plane, judged by rationals", "[tetrahedra]") {
    Random random(3);
    int near = 0, far = 0;
    for (int i = 0; i < cases(20000); ++i) {
        const auto corners = random_triangle(random);
        if (collinear(corners[0], corners[1], corners[2])) continue;
        Point3 p = between(corners, random_real(random, 0, .5), random_real(random, 0, .5));
        const Point3 h = allowance(corners);
        p = {moved(random, p.x, h.x / 5), moved(random, p.y, h.y / 5), moved(random, p.z, h.z / 5)};
        const bool expected = near_plane_in_rationals(p, corners);
        ++(expected ? near : far);
        REQUIRE(near_plane(p, corners) == expected);
    }
    CHECK(near > cases(20000) / 10);
    CHECK(far > cases(20000) / 10);
}

TEST_CASE(
    "allowance: the reach is more than its parts, and the volume within it more than Steiner's",
    "[tetrahedra]") {
    const std::array<Point3, 3> t{{{0, 0, 1}, {3, 0, 1}, {0, 4, 1}}};
    const Point3 e = allowance(t);
    const double along = e.z + 2 * e.x + 2 * e.y, d = reach(t);
    CHECK(d >= std::hypot(e.x, e.y, along));
    CHECK(d < 3 * (e.x + e.y + e.z));
    const double volume = volume_within_reach(t), pi = std::acos(-1.0);
    CHECK(volume >= 2 * d * 6 + pi / 2 * d * d * 12 + 4 * pi / 3 * d * d * d);
    CHECK(volume < 2.01 * d * 6);
}
