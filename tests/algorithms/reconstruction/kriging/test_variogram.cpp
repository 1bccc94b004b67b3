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
    const Variogram plate{VariogramModel::thin_plate, 1, 4, 10},
        cubic{VariogramModel::cubic, 1, 4, 10};
    CHECK(plate.at(20) == Approx(1 - 16 * std::log(2)));
    CHECK(plate.at(0) == 1);
    CHECK(cubic.at(20) == Approx(1 - 32));
    for (const char* name : {"spherical", "exponential", "gaussian", "power", "matern"})
        CHECK(name_of(variogram_model_named(name).value()) == name);
    CHECK(!variogram_model_named("auto"));
    const Variogram turned{VariogramModel::spherical, 0, 1, 10, 1, 90, 0.5};
    CHECK(turned.distance(0, 3) == Approx(3)); // along the main direction
    CHECK(turned.distance(3, 0) == Approx(6));
}

TEST_CASE("variogram: the experimental one is half the mean squared difference by distance",
          "[kriging]") {
    Random random(2);
    auto points = scattered(random, 60, 100);
    for (Point3& p : points) p.z = random_real(random, -1, 1);
    const auto bins = experimental_variogram(points, 1000);
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
