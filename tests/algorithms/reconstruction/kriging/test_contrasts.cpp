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

#include <terrane/algorithms/reconstruction/kriging/well_spread.hpp>

using namespace terrane;

TEST_CASE("kriging: contrasts are an orthogonal basis that the trend does not change",
          "[kriging]") {
    srand(4);
    for (const Eigen::Index m : {1, 3, 6}) {
        const Eigen::MatrixXd terms = Eigen::MatrixXd::Random(20, m);
        const Contrasts contrasts(terms);
        CHECK(contrasts.terms() == m);
        CHECK(contrasts.determined());
        Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(20, 20), columns = terms;
        contrasts.apply(basis);
        CHECK((basis * basis.transpose() - Eigen::MatrixXd::Identity(20, 20)).norm() < 1e-12);
        contrasts.apply(columns);
        CHECK(columns.bottomRows(20 - m).norm() < 1e-12);
        const Eigen::MatrixXd root = Eigen::MatrixXd::Random(20, 20),
                              kernel = root * root.transpose();
        Eigen::MatrixXd twice = kernel;
        contrasts.apply_twice(twice);
        CHECK((twice - basis * kernel * basis.transpose()).norm() < 1e-11);
        const Eigen::VectorXd data = Eigen::VectorXd::Random(20);
        Eigen::VectorXd numbers = data;
        contrasts.apply(numbers);
        CHECK((numbers - basis * data).norm() < 1e-12);
        CHECK((contrasts.trend_of(numbers) - terms.householderQr().solve(data)).norm() < 1e-11);
        contrasts.undo(numbers);
        CHECK((numbers - data).norm() < 1e-12);
        // Weights that reproduce the terms at a place do so at the data.
        Eigen::MatrixXd place = Eigen::MatrixXd::Random(m, 1), first = place;
        contrasts.reproduce(first);
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(20);
        weights.head(m) = first;
        contrasts.undo(weights);
        CHECK((terms.transpose() * weights - place).norm() < 1e-11);
        CHECK((squared(root) - root.transpose() * root).norm() < 1e-11);
    }
    const Eigen::MatrixXd root =
        Eigen::MatrixXd::Random(70, 70) + 9 * Eigen::MatrixXd::Identity(70, 70);
    Eigen::MatrixXd factor = root * root.transpose();
    CHECK(cholesky(factor, {}));
    factor.triangularView<Eigen::StrictlyUpper>().setZero();
    CHECK((factor * factor.transpose() - root * root.transpose()).norm() < 1e-9);
    CHECK((inverse_of_factor(factor) * factor - Eigen::MatrixXd::Identity(70, 70)).norm() < 1e-9);
    Eigen::MatrixXd negative = -Eigen::MatrixXd::Identity(3, 3);
    CHECK_FALSE(cholesky(negative, {}));
    Eigen::MatrixXd line = Eigen::MatrixXd::Random(20, 3);
    line.col(2) = 2 * line.col(1);
    CHECK_FALSE(Contrasts(line).determined());
}

TEST_CASE("kriging: the most likely nugget is that of a search with dense algebra", "[kriging]") {
    srand(6);
    const Eigen::MatrixXd root = Eigen::MatrixXd::Random(30, 30);
    const Eigen::MatrixXd kernel = root * root.transpose();
    const Eigen::VectorXd values =
        root * Eigen::VectorXd::Random(30) + 2 * Eigen::VectorXd::Random(30);
    const std::vector<Eigen::Index> trends{0, 2, 5};
    const auto found = TridiagonalKernel(kernel, values, trends).most_likely();
    REQUIRE(found.size() == trends.size());
    for (std::size_t t = 0; t < trends.size(); ++t) {
        const Eigen::Index n = 30 - trends[t];
        const auto likelihood = [&](double nugget) {
            Eigen::MatrixXd system = kernel.bottomRightCorner(n, n);
            system.diagonal().array() += nugget;
            const auto count = static_cast<double>(n);
            const double sill = values.tail(n).dot(system.ldlt().solve(values.tail(n))) / count;
            const Eigen::VectorXd pivots = system.ldlt().vectorD();
            return -(count * std::log(sill) + pivots.array().log().sum()) / 2;
        };
        CHECK(found[t].likelihood == Approx(likelihood(found[t].nugget / found[t].sill)));
        for (double factor = 1e-4; factor < 1e4; factor *= 1.3)
            CHECK(found[t].likelihood > likelihood(factor * kernel.diagonal().mean()) - 0.01);
    }
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
    CHECK(well_spread_pairs(points, 500, 10).gap > 0); // all are taken // none is left
}
