// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/point_surface.hpp>

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("connect_points: long edges are left out, by the plane of the points", "[planar]") {
    std::vector<Point3> points;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            if (std::hypot(i - 10, j - 10) > 4)
                points.push_back({10.0 * i, 10.0 * j, 30 * std::sin(0.3 * i)});
    const auto level = connect_points(points);
    REQUIRE(level);
    double area = doubled_area(points, level.value()) / 2;
    CHECK(area < 19 * 19 * 100 - M_PI * 1600 * 0.8);
    CHECK(area > 19 * 19 * 100 - M_PI * 2500 * 1.3);
    // The same points upright give the same surface, seen from the side.
    std::vector<Point3> upright;
    for (const Point3& p : points) upright.push_back({p.z / 10, p.x, p.y});
    const auto wall = connect_points(upright);
    REQUIRE(wall);
    CHECK(std::abs(double(wall.value().size()) - double(level.value().size())) < 20);
    CHECK(connect_points(points, {.max_edge = 1}).value().empty());
    CHECK(connect_points(points, {.max_edge = 1e9}).value().size() > level.value().size());
    CHECK(connect_points(points, {.max_edge = -1}).error().code == ErrorCode::bad_option);
}

TEST_CASE("connect_points: a steep horizon that is narrow is still seen from above", "[planar]") {
    std::vector<Point3> points;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 60; ++j)
            points.push_back({2.0 * i, 2.0 * j, 20 * std::sin(0.1 * j) + 0.5 * j});
    const auto strip = connect_points(points);
    REQUIRE(strip);
    CHECK(strip.value().size() == 2 * 7 * 59);
    for (const Triangle& t : strip.value()) CHECK(doubled_area(points, t) == 4);
}
