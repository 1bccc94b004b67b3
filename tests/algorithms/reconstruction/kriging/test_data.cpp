// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/data.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace terrane::kriging::detail;
using namespace test_support;

TEST_CASE("fill by kriging: new points keep off the border, and leave no room between them",
          "[kriging]") {
    constexpr double size = 3;
    const std::vector<Point3> points{{0, 0, 0},   {100, 0, 0}, {100, 40, 0},
                                     {55, 60, 0}, {50, 99, 0}, {0, 80, 0},
                                     {20, 20, 0}, {30, 50, 0}, {50, 25, 0}};
    const std::vector<Polygon> borders{{0, 1, 2, 3, 4, 5}, {6, 7, 8}};
    const auto places = places_within(points, borders, size, 20'000);
    const auto from_border = [&](const Point3& p) {
        double least = HUGE_VAL;
        for (const Polygon& polygon : borders)
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point3 &a = points[polygon[i]],
                             &b = points[polygon[(i + 1) % polygon.size()]];
                const double x = b.x - a.x, y = b.y - a.y;
                const double along = ((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y);
                const double part = std::clamp(along, 0.0, 1.0);
                least = std::min(least, std::hypot(a.x + part * x - p.x, a.y + part * y - p.y));
            }
        return least;
    };
    for (const Point3& p : places) {
        CHECK(is_inside(points, borders[0], p.x, p.y));
        CHECK(from_border(p) > 0.6 * size);
    }
    Random random(48);
    for (int n = 0; n < 1000; ++n) {
        const double x = random_real(random, 0, 100), y = random_real(random, 0, 100);
        if (!is_inside(points, borders[0], x, y)) continue;
        double nearest = from_border({x, y, 0});
        for (const Point3& p : places) nearest = std::min(nearest, std::hypot(p.x - x, p.y - y));
        CHECK(nearest < size);
    }
}
