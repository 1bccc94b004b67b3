// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("variogram: the models rise from the nugget as the header says", "[kriging]") {
    const Variogram spherical{VariogramModel::spherical, 1, 4, 10};
    CHECK(spherical.at(5) == Approx(1 + 4 * (1.5 * 0.5 - 0.5 * 0.125)));
    CHECK(spherical.at(10) == 5);
    CHECK(spherical.at(1000) == 5);
    const Variogram exponential{VariogramModel::exponential, 1, 4, 10};
    CHECK(exponential.at(10) == Approx(1 + 4 * (1 - std::exp(-3))));
    const Variogram gaussian{VariogramModel::gaussian, 1, 4, 10};
    CHECK(gaussian.at(5) == Approx(1 + 4 * (1 - std::exp(-0.75))));
    const Variogram power{VariogramModel::power, 1, 4, 10, 1.5};
    CHECK(power.at(20) == Approx(1 + 4 * std::pow(2, 1.5)));
    const Variogram turned{VariogramModel::spherical, 0, 1, 10, 1, 90, 0.5};
    CHECK(turned.distance(0, 3) == Approx(3)); // along the main direction
    CHECK(turned.distance(3, 0) == Approx(6));
}

TEST_CASE("variogram: fitting recovers the model of exact bins", "[kriging]") {
    for (const auto model : {VariogramModel::spherical, VariogramModel::exponential,
                             VariogramModel::gaussian, VariogramModel::power})
        for (const bool turned : {false, true}) {
            Variogram truth{model, 0.5, 8, 40, 1.3, turned ? 60.0 : 0.0, turned ? 0.4 : 1.0};
            std::vector<VariogramBin> bins;
            for (int d = 0; d < 12; ++d)
                for (int k = 1; k <= 15; ++k) {
                    const double turn = M_PI * (d + 0.5) / 12 - M_PI / 2, h = 5.0 * k;
                    const double dx = h * std::cos(turn), dy = h * std::sin(turn);
                    bins.push_back({dx, dy, h, truth.at(truth.distance(dx, dy)), 100});
                }
            const Variogram found = fit_variogram(bins);
            INFO(description(truth) << " found as " << description(found));
            CHECK(found.model == model);
            for (const VariogramBin& bin : bins)
                CHECK(found.at(found.distance(bin.dx, bin.dy)) == Approx(bin.gamma).epsilon(0.03));
            CHECK(found.ratio == Approx(truth.ratio));
        }
    CHECK(fit_variogram({}).sill == 0);
}

TEST_CASE("variogram: the experimental one is half the mean squared difference by distance",
          "[kriging]") {
    Random random(2);
    auto points = scattered(random, 60, 100);
    for (Point3& p : points) p.z = random_real(random, -1, 1);
    const auto bins = experimental_variogram(points, {}, 1000);
    double sum = 0, expected = 0;
    std::size_t pairs = 0;
    for (const VariogramBin& bin : bins) {
        sum += bin.gamma * double(bin.pairs);
        pairs += bin.pairs;
        CHECK(bin.distance >= std::hypot(bin.dx, bin.dy) * (1 - 1e-12));
        CHECK(bin.dx >= 0);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = i + 1; j < points.size(); ++j)
            expected += std::pow(points[i].z - points[j].z, 2) / 2;
    CHECK(pairs == 60 * 59 / 2);
    CHECK(sum == Approx(expected));
}
