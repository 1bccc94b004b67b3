// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/shapes.hpp"
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

TEST_CASE("deviation: the progress of measuring one surface ascends to 1, whatever the threads",
          "[quality]") {
    const auto ridge = [](double height) {
        Surface sheet = sheet_of(
            60, 60, 1.0, [](int, int) { return true; },
            [height](double x, double y) {
                return Point3{x, y, height * std::fmod(x, 5)};
            });
        Mesh mesh;
        mesh.surfaces.push_back({"ridge", Role::horizon});
        mesh.vertices = std::move(sheet.vertices);
        mesh.triangles = std::move(sheet.triangles);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            mesh.surfaces_of.push_back(std::array{0U});
        return mesh;
    };
    const Mesh low = ridge(0.25), high = ridge(0.5);
    const auto expected = deviations_of(low, high);
    for (const unsigned threads : {1U, 2U}) {
        std::vector<double> shares;
        Run run{.threads = threads};
        run.progress = [&](std::string_view stage, double share) {
            CHECK(stage == "measure");
            shares.push_back(share);
        };
        const auto measured = deviations_of(low, high, run);
        REQUIRE(measured.size() == 1);
        CHECK(measured[0].out == expected[0].out);
        CHECK(measured[0].back == expected[0].back);
        CHECK(std::is_sorted(shares.begin(), shares.end()));
        CHECK(shares.size() >= 8);
        CHECK(shares.back() == 1);
    }
}
