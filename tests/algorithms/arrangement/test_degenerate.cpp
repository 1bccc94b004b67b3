// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Families in which everything coincides: planes through one line, stacks in one plane, lattices,
// fans, copies. Each is so large that planes are pooled or segments merged. The verifier
// judges the arrangements; counts come from formulas or from all pairs of edges in rationals.
#include "support/oracle.hpp"
#include "support/points.hpp"
#include "support/soup_laws.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;

void add_triangle(Surface& s, const Point3& a, const Point3& b, const Point3& c) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), {a, b, c});
    s.triangles.push_back({first, first + 1, first + 2});
}

bool has_area(const Point3& a, const Point3& b, const Point3& c) {
    const std::vector<Point3> all{a, b, c};
    const auto p = oracle::points(all);
    for (const Axis axis : {Axis::x, Axis::y, Axis::z})
        if (oracle::orient2d(axis, p[0], p[1], p[2]) != Sign::Zero) return true;
    return false;
}

/// Arranges one surface. The verifier, the digest of other orders, axes and scales, and the arrays
/// of several threads must agree.
Arrangement arranged_by_the_laws(const Surface& surface) {
    const std::vector<Surface> surfaces{surface};
    auto a = arrange(surfaces);
    REQUIRE(a);
    CHECK(soup_laws::arrangement_flaw(surfaces, a.value()) == "");
    CHECK(soup_laws::metamorphic_flaw(surfaces, a.value()) == "");
    const auto again = arrange(surfaces, {}, {.threads = 3});
    REQUIRE(again);
    CHECK(again.value().triangles == a.value().triangles);
    CHECK(again.value().parents_of == a.value().parents_of);
    return std::move(a).value();
}

/// A rational point of the plane.
using Rational2 = std::array<mpq_class, 2>;

mpq_class cross(const Rational2& a, const Rational2& b, const Rational2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Returns the number of points that are corners, or in which two edges cross, from all pairs of
/// edges. Triangles must be flat in x and y.
std::size_t points_of_all_pairs(const Surface& s) {
    std::vector<std::array<Rational2, 2>> edges;
    std::set<Rational2> points;
    for (const Triangle& t : s.triangles)
        for (unsigned e = 0; e < 3; ++e) {
            const Point3 &a = s.vertices[t[e]], &b = s.vertices[t[(e + 1) % 3]];
            edges.push_back({Rational2{a.x, a.y}, Rational2{b.x, b.y}});
            points.insert(edges.back()[0]);
        }
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto& [a, b] = edges[i];
            const auto& [c, d] = edges[j];
            const mpq_class at_a = cross(c, d, a), at_b = cross(c, d, b);
            if (at_a * at_b >= 0 || cross(a, b, c) * cross(a, b, d) >= 0) continue;
            const mpq_class share = at_a / (at_a - at_b);
            points.insert(Rational2{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
        }
    return points.size();
}

/// Returns random triangles with corners on a lattice in the plane z = 2 x - y.
Surface flat_soup(int count, int side) {
    Random random(500);
    Surface s;
    while (s.triangles.size() < static_cast<std::size_t>(count)) {
        std::array<Point3, 3> t;
        for (Point3& p : t) {
            const double x = random_int(random, 0, side), y = random_int(random, 0, side);
            p = {x, y, 2 * x - y};
        }
        if (has_area(t[0], t[1], t[2])) add_triangle(s, t[0], t[1], t[2]);
    }
    return s;
}

/// Returns rectangles of two triangles in n planes through the z axis.
Surface star(int n) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double angle = 3.14159265358979 * i / n, x = std::cos(angle), y = std::sin(angle);
        add_triangle(s, {-x, -y, 0}, {x, y, 0}, {x, y, 1});
        add_triangle(s, {-x, -y, 0}, {x, y, 1}, {-x, -y, 1});
    }
    return s;
}

} // namespace

TEST_CASE("degenerate: planes through one line divide each other once") {
    const std::size_t n = 40;
    const Arrangement a = arranged_by_the_laws(star(static_cast<int>(n)));
    CHECK(a.triangles.size() == 6 * n);
    CHECK(a.vertices.size() == 4 * n + 3); // three on the axis
}

TEST_CASE("degenerate: nested coplanar triangles are rings") {
    const std::size_t n = 50;
    Surface s;
    for (std::size_t i = 1; i <= n; ++i) {
        const auto d = static_cast<double>(i);
        add_triangle(s, {0, 0, 0}, {d, 0, 0}, {0, d, 0});
    }
    const Arrangement a = arranged_by_the_laws(s);
    CHECK(a.triangles.size() == 2 * n - 1);
    CHECK(a.vertices.size() == 2 * n + 1);
    // The ring between i - 1 and i has two triangles, which triangles i to n contain.
    CHECK(a.parents_of.values.size() == n * n);
}

TEST_CASE("degenerate: coplanar triangles meet in the points of all pairs of their edges") {
    const Surface s = flat_soup(48, 6);
    const Arrangement a = arranged_by_the_laws(s);
    CHECK(a.vertices.size() == points_of_all_pairs(s));
}

TEST_CASE("degenerate: coplanar triangles that planes cross") {
    Surface s = flat_soup(50, 6);
    for (int i = 0; i < 12; ++i) { // several through one line, several coplanar
        const double x = 1 + i % 4, y = i % 3;
        add_triangle(s, {x, -1, -20}, {x, 9 - y, -20}, {x, 4, 30 + y});
        add_triangle(s, {-1, 3, -20}, {9, 3, -20 + y}, {4, 3 + x, 30});
    }
    arranged_by_the_laws(s);
}

TEST_CASE("degenerate: stacks of large and small triangles cross") {
    Surface s;
    for (int i = 1; i <= 40; ++i) {
        const double d = i;
        add_triangle(s, {-d, -1, 0}, {d, -1, 0}, {0, 2 * d, 0});
        add_triangle(s, {0, -d, -1}, {0, d, -1}, {0, 0.5, d});
    }
    arranged_by_the_laws(s);
}

TEST_CASE("degenerate: triangles on a lattice of 27 points") {
    Random random(501);
    Surface s;
    while (s.triangles.size() < 120) {
        std::array<Point3, 3> t;
        for (Point3& p : t) p = point_of([&] { return double(random_int(random, 0, 2)); });
        if (has_area(t[0], t[1], t[2])) add_triangle(s, t[0], t[1], t[2]);
    }
    arranged_by_the_laws(s);
}

TEST_CASE("degenerate: coplanar combs cross tooth by tooth") {
    const std::size_t n = 36;
    Surface s;
    for (std::size_t i = 0; i < n; ++i) {
        const auto d = static_cast<double>(i), m = static_cast<double>(n + 1);
        add_triangle(s, {d, -1, 0}, {d + 0.5, -1, 0}, {d + 0.25, m, 0});
        add_triangle(s, {-1, d, 0}, {-1, d + 0.5, 0}, {m, d + 0.25, 0});
    }
    const auto a = arrange(std::vector{s});
    REQUIRE(a);
    // A tooth has n crossings of two triangles each, n trapezoids of two, and its tip.
    CHECK(a.value().triangles.size() == 6 * n * n + 2 * n);
    CHECK(a.value().vertices.size() == 4 * n * n + 6 * n);
}

TEST_CASE("degenerate: fans at an edge and at a vertex stay as they are") {
    const std::size_t n = 100;
    Surface at_edge, at_vertex;
    for (std::size_t i = 0; i < n; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(n);
        const double angle = 6.28318530717959 * share, x = std::cos(angle), y = std::sin(angle);
        const double next = angle + 3.14159265358979 / static_cast<double>(n);
        add_triangle(at_edge, {0, 0, 0}, {0, 0, 1}, {x, y, 0.5});
        add_triangle(at_vertex, {0, 0, 0}, {x, y, 0.5}, {std::cos(next), std::sin(next), 0.5});
    }
    for (const Surface& s : {at_edge, at_vertex}) {
        const auto a = arrange(std::vector{s});
        REQUIRE(a);
        CHECK(a.value().triangles.size() == n);
        CHECK(a.value().statistics.divided == 0);
    }
}

TEST_CASE("degenerate: boxes on each other share their faces exactly") {
    const int n = 20;
    Surface s;
    const auto add_rectangle = [&](const Point3& a, const Point3& b, const Point3& c,
                                   const Point3& d) {
        add_triangle(s, a, b, c);
        add_triangle(s, a, c, d);
    };
    for (int i = 0; i < n; ++i) {
        const double x = 0.25 * i, z = i;
        const std::array<Point3, 8> q{{{x, 0, z},
                                       {x + 8, 0, z},
                                       {x + 8, 8, z},
                                       {x, 8, z},
                                       {x, 0, z + 1},
                                       {x + 8, 0, z + 1},
                                       {x + 8, 8, z + 1},
                                       {x, 8, z + 1}}};
        add_rectangle(q[0], q[3], q[2], q[1]);
        add_rectangle(q[4], q[5], q[6], q[7]);
        for (unsigned k = 0; k < 4; ++k)
            add_rectangle(q[k], q[(k + 1) % 4], q[(k + 1) % 4 + 4], q[k + 4]);
    }
    arranged_by_the_laws(s);
}

TEST_CASE("degenerate: copies of surfaces that cross are one surface with many names") {
    const std::size_t n = 100;
    Surface one;
    add_triangle(one, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    add_triangle(one, {1, 1, -1}, {1, 2, 1}, {2, 1, 1});
    const auto single = arrange(std::vector{one});
    const auto copies = arrange(std::vector<Surface>(n, one));
    REQUIRE(single);
    REQUIRE(copies);
    CHECK(copies.value().triangles.size() == single.value().triangles.size());
    CHECK(copies.value().vertices.size() == single.value().vertices.size());
    CHECK(copies.value().parents_of.values.size() == n * single.value().parents_of.values.size());
    const auto rounded = round_to_doubles(copies.value());
    REQUIRE(rounded);
    const auto of_one = round_to_doubles(single.value());
    REQUIRE(of_one);
    CHECK(rounded.value().regions.size() == n * of_one.value().regions.size());
    // Each region meets all regions at its border but itself.
    std::size_t meets = 0, expected = 0;
    for (const auto& r : rounded.value().regions) meets = std::max(meets, r.neighbours.size());
    for (const auto& r : of_one.value().regions)
        expected = std::max<std::size_t>(expected, n * (r.neighbours.size() + 1) - 1);
    CHECK(meets == expected);
}
