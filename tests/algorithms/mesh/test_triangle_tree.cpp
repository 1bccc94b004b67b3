// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/triangle_tree.hpp>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/mesh/vectors.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Samples the triangle finely: an upper bound that exceeds the distance by at most a cell.
double sampled_distance(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    double best = HUGE_VAL;
    constexpr int n = 60;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) {
            const double s = double(i) / n, t = double(j) / n;
            best = std::min(best, std::hypot(a.x + s * (b.x - a.x) + t * (c.x - a.x) - p.x,
                                             a.y + s * (b.y - a.y) + t * (c.y - a.y) - p.y,
                                             a.z + s * (b.z - a.z) + t * (c.z - a.z) - p.z));
        }
    return best;
}

} // namespace

TEST_CASE("TriangleTree: the nearest point is on the triangles, and as far as the distance",
          "[borders]") {
    CHECK(nearest_on_triangle({1, 1, 3}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{1, 1, 0});
    CHECK(nearest_on_triangle({1, -2, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{1, 0, 0});
    CHECK(nearest_on_triangle({-3, -4, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{0, 0, 0});
    Random random(8);
    const auto points = points_of(random, Family::uniform, 300);
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < 100; ++t) triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    const TriangleTree tree(points, triangles);
    for (const Point3& p : points_of(random, Family::uniform, 200)) {
        const double d = tree.distance(p, HUGE_VAL);
        const auto near = tree.nearest(p, HUGE_VAL);
        REQUIRE(near);
        CHECK(near->distance == Approx(d).margin(1e-15));
        CHECK(length(minus(near->place, p)) == near->distance);
        if (d > 1e-9) CHECK_FALSE(tree.nearest(p, d * 0.999));
    }
    CHECK_FALSE(TriangleTree(points, {}).nearest({0, 0, 0}, HUGE_VAL));
}

TEST_CASE("distance_to_triangle: above the face, beside an edge, beyond a corner", "[borders]") {
    const Point3 a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
    CHECK(distance_to_triangle({1, 1, 3}, a, b, c) == 3);
    CHECK(distance_to_triangle({1, -2, 0}, a, b, c) == 2);
    CHECK(distance_to_triangle({-3, -4, 0}, a, b, c) == 5);
    CHECK(distance_to_triangle({1, 1, 0}, a, b, c) == 0);
    CHECK(distance_to_triangle({0, 1, 0}, a, a, a) == 1);
}

TEST_CASE("TriangleTree: several threads may search at a time", "[borders][threads]") {
    Random random(12);
    const auto points = points_of(random, Family::uniform, 9000);
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < 3000; ++t) triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    const TriangleTree alone(points, triangles);
    const auto places = points_of(random, Family::uniform, 50);
    std::vector<double> right;
    for (const Point3& p : places) right.push_back(alone.distance(p, HUGE_VAL));
    for (int k = 0; k < 20; ++k) {
        const TriangleTree tree(points, triangles);
        std::vector<std::vector<double>> found(4);
        std::vector<std::thread> threads;
        for (auto& distances : found)
            threads.emplace_back([&] {
                for (const Point3& p : places) distances.push_back(tree.distance(p, HUGE_VAL));
            });
        for (std::thread& t : threads) t.join();
        for (const auto& distances : found) REQUIRE(distances == right);
    }
}

TEST_CASE("TriangleTree: the nearest triangle agrees with brute force", "[borders]") {
    Random random(11);
    std::vector<Point3> points;
    std::vector<Triangle> triangles;
    const auto real = [&] { return random_real(random, -10, 10); };
    for (std::uint32_t t = 0; t < 300; ++t) {
        const Point3 at = point_of(real);
        for (int i = 0; i < 3; ++i)
            points.push_back({at.x + random_real(random, -1, 1), at.y + random_real(random, -1, 1),
                              at.z + random_real(random, -1, 1)});
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const TriangleTree tree(points, triangles);
    for (int i = 0; i < 300; ++i) {
        const Point3 p = point_of(real);
        double best = HUGE_VAL, sampled = HUGE_VAL;
        for (const auto& [a, b, c] : triangles) {
            best = std::min(best, distance_to_triangle(p, points[a], points[b], points[c]));
            if (i < 10)
                sampled = std::min(sampled, sampled_distance(p, points[a], points[b], points[c]));
        }
        CHECK(tree.distance(p, HUGE_VAL) == best);
        CHECK(tree.distance(p, best / 2) == best / 2);
        if (i < 10) CHECK(std::abs(best - sampled) < 0.06);
    }
    CHECK(TriangleTree(points, {}).distance({0, 0, 0}, 7) == 7);
}
