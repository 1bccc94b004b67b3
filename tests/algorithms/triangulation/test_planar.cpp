// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/planar.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/kernel/predicates.hpp>

using namespace terrane;
using namespace test_support;

namespace {

std::vector<Point3> lattice_points(Random& random, int count, int size) {
    std::vector<Point3> points;
    for (int i = 0; i < count; ++i)
        points.push_back({double(random_int(random, -size, size)),
                          double(random_int(random, -size, size)), random_real(random, -9, 9)});
    return points;
}

/// Computes twice the area of the convex hull; exact for integers.
double doubled_hull_area(std::vector<Point3> p) {
    std::sort(p.begin(), p.end());
    std::vector<Point3> hull;
    for (int side = 0; side < 2; ++side) {
        const auto start = hull.size();
        for (const Point3& q : p) {
            while (hull.size() >= start + 2 &&
                   orient2d(Axis::z, hull[hull.size() - 2], hull.back(), q) != Sign::Positive)
                hull.pop_back();
            hull.push_back(q);
        }
        hull.pop_back();
        std::reverse(p.begin(), p.end());
    }
    double sum = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point3 &a = hull[i], &b = hull[(i + 1) % hull.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

/// Returns a star-shaped polygon with random radii in a range, seen counterclockwise.
std::vector<Point3> star(Random& random, std::size_t corners, double low, double high) {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < corners; ++i) {
        const double turn = 2 * M_PI * double(i) / double(corners);
        const double r = random_real(random, low, high);
        points.push_back({r * std::cos(turn), r * std::sin(turn), random_real(random, -1, 1)});
    }
    return points;
}

Polygon numbered(std::uint32_t from, std::size_t count) {
    Polygon polygon(count);
    for (auto& corner : polygon) corner = from++;
    return polygon;
}

double doubled_polygon_area(std::span<const Point3> p, const Polygon& polygon) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += doubled_area(p, Triangle{polygon[0], polygon[i], polygon[i + 1]});
    return sum;
}

std::map<std::array<std::uint32_t, 2>, int> edge_counts(const std::vector<Triangle>& triangles) {
    std::map<std::array<std::uint32_t, 2>, int> counts;
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) {
            const auto a = t[i], b = t[(i + 1) % 3];
            ++counts[{std::min(a, b), std::max(a, b)}];
        }
    return counts;
}

/// Tells whether a point lies in a triangle or on its border, seen along z.
bool is_covered(std::span<const Point3> p, const std::vector<Triangle>& triangles,
                const Point3& q) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
        for (unsigned i = 0; i < 3; ++i)
            if (orient2d(Axis::z, p[t[i]], p[t[(i + 1) % 3]], q) == Sign::Negative) return false;
        return true;
    });
}

/// Counts the triangles that are not counterclockwise, and the pairs at an edge of which one has
/// the opposite corner of the other strictly inside its circle. Edges of polygons have one
/// triangle. If there are none, the triangulation is the constrained Delaunay one.
std::size_t delaunay_flaws(std::span<const Point3> p, const std::vector<Triangle>& triangles) {
    std::size_t flaws = 0;
    std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 3>> side_of; // directed
    for (const Triangle& t : triangles) {
        if (orient2d(Axis::z, p[t[0]], p[t[1]], p[t[2]]) != Sign::Positive) ++flaws;
        for (unsigned i = 0; i < 3; ++i) side_of[{t[i], t[(i + 1) % 3]}] = t;
    }
    for (const auto& [edge, t] : side_of) {
        const auto other = side_of.find({edge[1], edge[0]});
        if (other == side_of.end()) continue;
        for (const std::uint32_t v : other->second)
            if (v != edge[0] && v != edge[1] &&
                in_circle(Axis::z, p[t[0]], p[t[1]], p[t[2]], p[v]) == Sign::Positive)
                ++flaws;
    }
    return flaws;
}

} // namespace

TEST_CASE("delaunay: fills the convex hull, and no circle holds a point", "[planar]") {
    Random random(3);
    for (int n = 0; n < cases(200); ++n) {
        const auto points = lattice_points(random, random_int(random, 3, 30), 5);
        const auto triangles = delaunay(points);
        REQUIRE(triangles);
        CHECK(doubled_area(points, triangles.value()) == doubled_hull_area(points));
        CHECK(delaunay_flaws(points, triangles.value()) == 0);
        for (const Triangle& t : triangles.value()) {
            CHECK(orient2d(Axis::z, points[t[0]], points[t[1]], points[t[2]]) == Sign::Positive);
            for (const Point3& p : points)
                CHECK(in_circle(Axis::z, points[t[0]], points[t[1]], points[t[2]], p) !=
                      Sign::Positive);
        }
    }
}

TEST_CASE("delaunay: the test sees an edge that is swapped", "[planar]") {
    const std::vector<Point3> kite{{0, 0, 0}, {4, 1, 0}, {8, 0, 0}, {4, -1, 0}};
    CHECK(delaunay_flaws(kite, {{0, 3, 1}, {3, 2, 1}}) == 0);
    CHECK(delaunay_flaws(kite, {{0, 3, 2}, {0, 2, 1}}) == 2); // from either side
    CHECK(delaunay_flaws(kite, {{0, 1, 3}, {3, 2, 1}}) == 1); // turned over
}

TEST_CASE("delaunay: the same triangles whatever the order of the points", "[planar]") {
    Random random(4);
    const auto triangles_of = [](const std::vector<Point3>& points) {
        const auto triangles = delaunay(points);
        REQUIRE(triangles);
        std::set<std::set<Point3>> result;
        for (const Triangle& t : triangles.value())
            result.insert({points[t[0]], points[t[1]], points[t[2]]});
        return result;
    };
    std::vector<Point3> points;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 7; ++j) points.push_back({0.1 * i, 0.1 * j, double(i * j)});
    const auto expected = triangles_of(points);
    CHECK(expected.size() == 2 * 8 * 6);
    std::shuffle(points.begin(), points.end(), random);
    CHECK(triangles_of(points) == expected);
}

TEST_CASE("delaunay: few, collinear, coinciding and extreme points", "[planar]") {
    CHECK(delaunay({}).value().empty());
    CHECK(delaunay(std::vector<Point3>{{0, 0, 0}, {1, 1, 0}}).value().empty());
    CHECK(delaunay(std::vector<Point3>{{0, 0, 0}, {1, 1, 0}, {2, 2, 5}}).value().empty());
    CHECK(delaunay(std::vector<Point3>(5, {1, 2, 3})).value().empty());
    const std::vector<Point3> same{{0, 0, 0}, {0, 0, 7}, {1, 0, 0}, {0, 1, 0}};
    CHECK(delaunay(same).value() == std::vector<Triangle>{{0, 2, 3}});
    for (const double size : {5e-324, 1e-200, 1e200, 9e299}) {
        const std::vector<Point3> p{{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        CHECK(delaunay(p).value().size() == 1);
    }
    CHECK(delaunay(std::vector<Point3>{{2e300, 0, 0}}).error().code == ErrorCode::bad_number);
    CHECK(delaunay(std::vector<Point3>{{NAN, 0, 0}}).error().code == ErrorCode::bad_number);
}

TEST_CASE("triangulate_inside: a star with an island, filled but for the island", "[planar]") {
    Random random(6);
    for (int n = 0; n < cases(60); ++n) {
        auto points = star(random, 40, 5, 10);
        const auto island = star(random, 12, 1, 4);
        points.insert(points.end(), island.begin(), island.end());
        const std::vector<Polygon> polygons{numbered(0, 40), numbered(40, 12)};
        for (int i = 0; i < 80; ++i)
            points.push_back({random_real(random, -9, 9), random_real(random, -9, 9), 0});
        const auto result = triangulate_inside(points, polygons);
        REQUIRE(result);
        const auto& triangles = result.value();
        const double expected =
            doubled_polygon_area(points, polygons[0]) - doubled_polygon_area(points, polygons[1]);
        CHECK(doubled_area(points, triangles) == Approx(expected).epsilon(1e-12));
        const auto counts = edge_counts(triangles);
        std::size_t border = 0;
        for (const auto& [edge, count] : counts) border += count == 1 ? 1 : 0;
        CHECK(border == 52);
        for (const Polygon& polygon : polygons)
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const auto a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                const auto found = counts.find({std::min(a, b), std::max(a, b)});
                CHECK((found != counts.end() && found->second == 1));
            }
        // A point that is no vertex is outside: it lies in no triangle.
        std::set<std::uint32_t> used;
        for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
        CHECK(used.size() > 52);
        for (std::uint32_t p = 0; p < points.size(); ++p)
            if (!used.contains(p)) CHECK_FALSE(is_covered(points, triangles, points[p]));
        CHECK(delaunay_flaws(points, triangles) == 0);
    }
}

TEST_CASE("triangulate_inside: cocircular and collinear points leave a Delaunay triangulation",
          "[planar]") {
    Random random(7);
    for (int n = 0; n < cases(60); ++n) {
        std::vector<Point3> points{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0},
                                   {-3, -1, 0}, {2, -3, 0}, {4, 2, 0}};
        const std::vector<Polygon> polygons{numbered(0, 4), numbered(4, 3)};
        std::set<std::array<double, 2>> places;
        for (const Point3& p : points) places.insert({p.x, p.y});
        for (const Point3& p : lattice_points(random, 60, 8))
            if (places.insert({p.x, p.y}).second) points.push_back(p);
        const auto triangles = triangulate_inside(points, polygons);
        REQUIRE(triangles);
        CHECK(doubled_area(points, triangles.value()) ==
              doubled_polygon_area(points, polygons[0]) -
                  doubled_polygon_area(points, polygons[1]));
        CHECK(delaunay_flaws(points, triangles.value()) == 0);
    }
}

TEST_CASE("triangulate_inside: polygons that cross or touch are refused", "[planar]") {
    const auto code = [](std::vector<Point3> points, std::vector<Polygon> polygons) {
        const auto result = triangulate_inside(points, polygons);
        return result ? ErrorCode::internal : result.error().code;
    };
    const auto refused = ErrorCode::improper_contact;
    const std::vector<Point3> bow{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
    CHECK(code(bow, {{0, 1, 2, 3}}) == refused);
    CHECK(code(bow, {{0, 2, 1, 3}}) == ErrorCode::internal); // fine
    const std::vector<Point3> spike{{0, 0, 0}, {4, 0, 0}, {2, 0, 1}, {2, 2, 0}};
    CHECK(code(spike, {{0, 1, 2, 3}}) == refused); // turns back on itself
    const std::vector<Point3> touching{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}};
    CHECK(code(touching, {{0, 1, 2, 3, 4}}) == refused);
    const std::vector<Point3> upright{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 4, 0}};
    CHECK(code(upright, {{0, 1, 2, 3}}) == refused); // two corners coincide
    CHECK(code(bow, {{0, 1, 9}}) == ErrorCode::bad_index);
}
