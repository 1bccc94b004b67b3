// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/nearby_rest.hpp>

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("kriging: the rest meets any number of values, and fades away from them", "[kriging]") {
    for (const std::size_t n : {1U, 2U, 49U, 8000U}) {
        auto points = random_points(n, 9, 10);
        for (Point3& p : points) p.z = 0.2 * std::sin(p.x); // on a surface, as data are
        const auto values = values_at(points, [](const Point3& p) { return std::cos(p.x * p.y); });
        const NearbyRest rest(points, values, 2);
        double missed = 0;
        for (std::size_t i = 0; i < n; ++i)
            missed = std::max(missed, std::fabs(rest(points[i]) - values[i]));
        CHECK(missed < 1e-9);
        CHECK(rest({0, 0, 100}) == 0);
        const double largest =
            std::abs(*std::ranges::max_element(values, {}, [](double v) { return std::abs(v); }));
        Point3 off = points[0];
        off.x += 1e-3;
        CHECK(std::fabs(rest(off)) <= largest);
    }
}
