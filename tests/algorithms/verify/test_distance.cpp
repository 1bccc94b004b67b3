// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests distances, with which the verifier judges moved triangles.
#include <terrane/algorithms/verify/detail/distance.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

#include "support/verify_points.hpp"

namespace {

using namespace terrane;
using namespace terrane::verifier;
using namespace verify_points;

} // namespace

TEST_CASE("verifier: distance of points, with denominators") {
    CHECK(within(point(0, 0, 0), point(3, 4, 0), 5));
    CHECK_FALSE(within(point(0, 0, 0), point(3, 4, 1), 5));
    CHECK(within(point(1, 0, 0, 2), point(1, 0, 0, 3), 1));
    CHECK_FALSE(within(point(1, 0, 0, 2), point(1, 0, 0, 3), 0));
}

TEST_CASE("verifier: distance to a segment: beyond its ends, beside it, in fractions") {
    const Vector4 a = point(0, 0, 0), b = point(10, 0, 0);
    CHECK(within_of_segment(point(-3, 4, 0), a, b, 5));
    CHECK_FALSE(within_of_segment(point(-3, 4, 1), a, b, 5));
    CHECK(within_of_segment(point(13, 0, 4), a, b, 5));
    CHECK(within_of_segment(point(4, 3, 4), a, b, 5));
    CHECK_FALSE(within_of_segment(point(4, 3, 5), a, b, 5));
    CHECK(within_of_segment(point(9, 10, 0, 2), a, b, 5));
    CHECK_FALSE(within_of_segment(point(9, 11, 0, 2), a, b, 5));
}

TEST_CASE("verifier: distance to a triangle, compared with a fine grid of its points") {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> coordinate(-20, 20);
    const auto draw = [&] {
        return point(coordinate(random), coordinate(random), coordinate(random));
    };
    for (int i = 0; i < 300; ++i) {
        const Vector4 a = draw(), b = draw(), c = draw(), p = draw();
        const auto normal = cross(difference(b, a), difference(c, a));
        if (sgn(dot(normal, normal)) == 0) continue;
        double nearest = 1e9;
        constexpr int n = 60;
        for (int u = 0; u <= n; ++u)
            for (int v = 0; u + v <= n; ++v) {
                double squared = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double at =
                        (u * a[k].get_d() + v * b[k].get_d() + (n - u - v) * c[k].get_d()) / n;
                    squared += (at - p[k].get_d()) * (at - p[k].get_d());
                }
                nearest = std::min(nearest, std::sqrt(squared));
            }
        CHECK(within(p, {&a, &b, &c}, mpz_class(std::ceil(nearest))));
        const double below = std::floor(nearest - 1.2); // a point of the grid is within 1.2
        if (below >= 0) CHECK_FALSE(within(p, {&a, &b, &c}, mpz_class(below)));
    }
}

TEST_CASE("verifier: a segment near triangles, one after the other") {
    const std::vector<Vector4> points{point(0, 0, 0),   point(-9, 0, 0),  point(-9, 9, 0),   // 0
                                      point(100, 0, 0), point(109, 0, 0), point(109, 9, 0),  // 3
                                      point(50, 31, 0), point(50, 40, 0), point(51, 40, 0)}; // 6
    const Vector4 start = point(0, 0, 0), end = point(100, 0, 0);
    const auto is_near = [&](const std::vector<Triangle>& triangles, int bound) {
        return NearTriangles(points, triangles, bound).reach(start, end);
    };
    const Triangle left{0, 1, 2}, right{3, 4, 5}, middle{6, 7, 8};
    CHECK(is_near({left, right}, 50)); // the middle is just so far from both
    CHECK_FALSE(is_near({left, right}, 49));
    CHECK_FALSE(is_near({left}, 99));
    CHECK(is_near({left}, 100));
    // The bound 35 reaches from the left triangle to x = 35, and from the middle triangle to
    // x = 33.8, which is 50 - sqrt(35^2 - 31^2). The bound 34 reaches to 34 and to 36.04.
    CHECK(is_near({left, middle, right}, 35));
    CHECK_FALSE(is_near({left, middle, right}, 34));
    CHECK_FALSE(is_near({left, middle}, 50));
}
