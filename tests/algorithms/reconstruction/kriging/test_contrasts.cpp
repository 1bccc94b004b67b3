// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the tridiagonal form of a kernel with dense linear algebra.
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>

#include <cmath>

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
