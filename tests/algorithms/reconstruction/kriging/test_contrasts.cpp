// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the tridiagonal form of a kernel with dense linear algebra, and checks which data are
// selected.
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace terrane;

TEST_CASE("kriging: what a fit misses and its freedom agree with dense algebra", "[kriging]") {
    srand(5);
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(24, 24);
    const Eigen::MatrixXd kernel = root * root.transpose();
    const Eigen::VectorXd values = Eigen::VectorXd::Random(24);
    const TridiagonalKernel form(kernel, values);
    CHECK(form.scale() == Approx(kernel.diagonal().mean()));
    for (const double nugget : {1e-6, 0.1, 3.0, 1e4}) {
        Eigen::MatrixXd system = kernel;
        system.diagonal().array() += nugget;
        const Eigen::MatrixXd inverse = system.inverse();
        CHECK(form.missed(nugget) == Approx((nugget * inverse * values).norm()).epsilon(1e-6));
        CHECK(form.freedom(nugget) == Approx((kernel * inverse).trace()).epsilon(1e-6));
    }
}

TEST_CASE("kriging: the most likely nugget is that of a search with dense algebra", "[kriging]") {
    srand(6);
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(30, 30);
    const Eigen::MatrixXd kernel = root * root.transpose();
    const Eigen::VectorXd values =
        root * Eigen::VectorXd::Random(30) + 2 * Eigen::VectorXd::Random(30);
    const auto likelihood = [&](double nugget) {
        Eigen::MatrixXd system = kernel;
        system.diagonal().array() += nugget;
        const double sill = values.dot(system.ldlt().solve(values)) / 30;
        const Eigen::VectorXd pivots = system.ldlt().vectorD();
        return -(30 * std::log(sill) + pivots.array().log().sum()) / 2;
    };
    const TridiagonalKernel form(kernel, values);
    const auto found = form.most_likely(HUGE_VAL);
    CHECK(found.likelihood == Approx(likelihood(found.nugget / found.sill)));
    for (double factor = 1e-4; factor < 1e4; factor *= 1.3)
        CHECK(found.likelihood > likelihood(factor * form.scale()) - 0.01);
    // A bound on the nugget is kept.
    CHECK(form.most_likely(found.nugget / 10).nugget <= found.nugget / 10);
}

TEST_CASE("kriging: noise alone is the limit of a large nugget, and a surface must be worth it",
          "[kriging]") {
    srand(7);
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(40, 40);
    const Eigen::MatrixXd kernel = root * root.transpose();
    const Eigen::VectorXd noise = Eigen::VectorXd::Random(40);
    const NoiseAlone alone(noise);
    CHECK(alone.variance == Approx(noise.squaredNorm() / 40));
    const auto likely = TridiagonalKernel(kernel, noise).most_likely(HUGE_VAL);
    CHECK(likely.likelihood > alone.likelihood - 0.1); // the largest nugget is nearly alone
    CHECK(alone.probability_of(likely, 2) < 0.6);
    LikelyNugget even = likely;
    CHECK(alone.price == Approx(std::log(40) / 2)); // more data, less luck
    even.likelihood = alone.likelihood + 2 * alone.price;
    CHECK(alone.probability_of(even, 2) == Approx(0.5));
    CHECK(alone.probability_of(even, 1) > 0.5);
    const Eigen::VectorXd surface = 10 * root * Eigen::VectorXd::Random(40);
    const auto clear = TridiagonalKernel(kernel * kernel, surface).most_likely(HUGE_VAL);
    CHECK(NoiseAlone(surface).probability_of(clear, 2) > 0.99);
}

TEST_CASE("kriging: neighbours of well-spread points are as near as any, in any order",
          "[kriging]") {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> somewhere(0, 100);
    std::vector<Point3> points;
    for (int i = 0; i < 400; ++i)
        points.push_back({somewhere(random), somewhere(random), somewhere(random)});
    const auto places = [](const std::vector<Point3>& of, const SpreadPairs& pairs) {
        std::set<Point3> chosen;
        for (const auto i : pairs.chosen) chosen.insert(of[i]);
        return chosen;
    };
    const auto pairs = well_spread_pairs(points, 30, 10);
    CHECK(pairs.chosen.size() == 40);
    CHECK(places(points, pairs).size() == 40);
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return std::hypot(points[a].x - points[b].x, points[a].y - points[b].y);
    };
    for (std::size_t k = 0; k < 10; ++k) {
        const auto of = pairs.chosen[k], taken = pairs.chosen[30 + k];
        for (std::uint32_t i = 0; i < points.size(); ++i)
            if (std::find(pairs.chosen.begin(), pairs.chosen.end(), i) == pairs.chosen.end())
                CHECK(near(of, i) >= near(of, taken));
    }
    CHECK(pairs.gap > 0);
    CHECK(pairs.gap < 10);
    auto mixed = points;
    std::shuffle(mixed.begin(), mixed.end(), random);
    const auto again = well_spread_pairs(mixed, 30, 10);
    CHECK(places(mixed, again) == places(points, pairs));
    CHECK(again.gap == pairs.gap);
    CHECK(well_spread_pairs(points, 500, 10).gap == 0); // none is left
}
