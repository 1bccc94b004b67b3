// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/patches.hpp>

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

TEST_CASE("rbf: patches interpolate any number of values and fade away from them", "[rbf]") {
    CHECK(RbfPatches()({1, 2, 3}) == 0);
    for (const std::size_t n : {1U, 2U, 49U, 8000U}) {
        auto points = random_points(n, 9, 10);
        for (Point3& p : points) p.z = 0.2 * std::sin(p.x); // on a surface, as data are
        const auto values = values_at(points, [](const Point3& p) { return std::cos(p.x * p.y); });
        const RbfPatches patches(points, values);
        CHECK(patches.size() >= n / 48);
        double missed = 0;
        for (std::size_t i = 0; i < n; ++i)
            missed = std::max(missed, std::fabs(patches(points[i]) - values[i]));
        CHECK(missed < 1e-9);
        CHECK(patches({0, 0, 100}) == 0);
    }
}
