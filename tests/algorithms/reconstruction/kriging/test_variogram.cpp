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
    for (const double ratio : {1.0, 0.5}) {
        const Variogram model{VariogramModel::spherical, 0, 1, 10, 1, 0, ratio};
        const auto classes = experimental_variogram(points, model, 75);
        REQUIRE(classes.size() == 15);
        for (std::size_t k = 0; k < classes.size(); ++k) {
            double squares = 0, distances = 0, pairs = 0;
            for (std::size_t i = 0; i < points.size(); ++i)
                for (std::size_t j = i + 1; j < points.size(); ++j) {
                    const double h =
                        std::hypot(points[i].x - points[j].x, (points[i].y - points[j].y) / ratio);
                    if (h <= 5.0 * double(k) || h > 5.0 * double(k + 1)) continue;
                    squares += std::pow(points[i].z - points[j].z, 2) / 2;
                    distances += h;
                    ++pairs;
                }
            REQUIRE(pairs > 0);
            CHECK(classes[k][0] == Approx(distances / pairs));
            CHECK(classes[k][1] == Approx(squares / pairs));
        }
    }
}
