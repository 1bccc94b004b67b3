// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/quality.hpp>

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// Computes 2 r / R by another formula: 8 sin(A/2) sin(B/2) sin(C/2).
double by_half_angles(const std::array<double, 3>& degrees) {
    double product = 8;
    for (const double d : degrees) product *= std::sin(d / 2 * std::acos(-1.0) / 180);
    return product;
}

} // namespace

TEST_CASE("quality: known triangles have their known quality", "[quality]") {
    const double h = std::sqrt(3.0) / 2;
    CHECK(quality_of({0, 0, 0}, {1, 0, 0}, {0.5, h, 0}) == Approx(1).epsilon(1e-14));
    CHECK(quality_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}) ==
          Approx(2 * (std::sqrt(2.0) - 1)).epsilon(1e-14));
    CHECK(quality_of({0, 0, 0}, {1, 1, 1}, {2, 2, 2}) == 0);
    CHECK(quality_of({1, 2, 3}, {1, 2, 3}, {1, 2, 3}) == 0);
    const auto angles = angles_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    CHECK(angles[0] == Approx(90));
    CHECK(angles[1] == Approx(45));
    CHECK(angles[2] == Approx(45));
}

TEST_CASE("quality: q and angles agree, in any order of corners and at any scale", "[quality]") {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto p = points_of(random, Family::uniform, 3);
        const auto angles = angles_of(p[0], p[1], p[2]);
        const double q = quality_of(p[0], p[1], p[2]);
        REQUIRE(angles[0] + angles[1] + angles[2] == Approx(180).epsilon(1e-12));
        REQUIRE(q == Approx(by_half_angles(angles)).epsilon(1e-9));
        REQUIRE(q == Approx(quality_of(p[2], p[0], p[1])).epsilon(1e-12));
        for (const int power : {60, 1020, -900}) {
            const auto larger = [&](const Point3& a) {
                return Point3{std::ldexp(a.x, power), std::ldexp(a.y, power),
                              std::ldexp(a.z, power)};
            };
            REQUIRE(quality_of(larger(p[0]), larger(p[1]), larger(p[2])) == q);
        }
    }
}

TEST_CASE("quality: a report counts each triangle and each edge once", "[quality]") {
    const Surface s = torus({0, 0, 0}, 3, 1, 12);
    const QualityReport r = measure_quality(s.vertices, s.triangles);
    CHECK(r.triangles == s.triangles.size());
    CHECK(std::accumulate(r.histogram.begin(), r.histogram.end(), std::size_t{0}) == r.triangles);
    CHECK(r.q.min <= r.q.percentiles[0]);
    CHECK(r.q.percentiles[4] <= r.q.max);
    const auto& w = s.triangles[r.worst];
    CHECK(quality_of(s.vertices[w[0]], s.vertices[w[1]], s.vertices[w[2]]) == r.q.min);
    CHECK(measure_quality(s.vertices, {}).worst == UINT32_MAX);
    const std::vector<double> values{3, 1, 2};
    const Spread spread = spread_of(values);
    CHECK(spread.min == 1);
    CHECK(spread.mean == 2);
    CHECK(spread.percentiles[2] == 2);
}
