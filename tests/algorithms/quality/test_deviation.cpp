// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/deviation.hpp>

#include <cmath>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("deviation: the distance of two levels is measured, and the bound exceeds the samples",
          "[quality]") {
    const Surface low = level(0, 0, 0, 4, 4), high = level(0.5, 0, 0, 4, 4);
    CHECK(sampled_distance(high, low) == Approx(0.5));
    CHECK(distance_bound(high, low, 0.01) >= 0.5);
    CHECK(distance_bound(high, low, 0.01) <= 0.51);
    const Surface part = level(0, 0, 0, 1, 1); // one-sided: the whole is far from the part
    CHECK(sampled_distance(part, low) == Approx(0).margin(1e-12));
    CHECK(sampled_distance(low, part) == Approx(3 * std::sqrt(2.0)));
    // No sample hits the top of this ridge.
    const Surface tent{"tent",
                       Role::unknown,
                       {{0, 0, 0}, {1, 0, 0.1}, {4, 0, 0}, {0, 4, 0}},
                       {{0, 1, 3}, {1, 2, 3}}};
    const Surface flat{"flat", Role::unknown, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
    const double bound = distance_bound(flat, tent, 0.001);
    CHECK(bound >= sampled_distance(flat, tent));
    CHECK(bound == Approx(0.1).margin(0.01));
}
