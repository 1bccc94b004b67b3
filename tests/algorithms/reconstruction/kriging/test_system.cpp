// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"

using namespace terrane;
using namespace terrane::kriging::detail;
using namespace test_support;

namespace {

/// Simulates a field with this variogram by the Cholesky factor of its covariances.
void draw_heights(Random& random, std::vector<Point3>& points, const Variogram& v) {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd c(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const Point3 &p = points[std::size_t(i)], &q = points[std::size_t(j)];
            const double h = v.distance(p.x - q.x, p.y - q.y);
            c(i, j) = v.sill + v.nugget - (h > 0 ? v.at(h) : 0) + (i == j ? 1e-10 * v.sill : 0);
        }
    std::normal_distribution<double> normal;
    Eigen::VectorXd draw(n);
    for (Eigen::Index i = 0; i < n; ++i) draw[i] = normal(random);
    const Eigen::VectorXd z = c.llt().matrixL() * draw;
    for (Eigen::Index i = 0; i < n; ++i) points[std::size_t(i)].z = z[i];
}

Estimate at(const System& system, double x, double y) {
    REQUIRE(system.ready());
    const Point3 p{x, y, 0};
    return system.at(std::span(&p, 1), true)[0];
}

/// Solves the textbook system with a Lagrange multiplier, in variograms, by full pivoting.
Estimate by_the_book(const std::vector<Point3>& data, const Variogram& v, double x, double y) {
    const auto n = static_cast<Eigen::Index>(data.size());
    const auto gamma = [&](double dx, double dy) {
        const double h = v.distance(dx, dy);
        return h > 0 ? v.at(h) - v.nugget : 0.0;
    };
    Eigen::MatrixXd a = Eigen::MatrixXd::Ones(n + 1, n + 1);
    Eigen::VectorXd b = Eigen::VectorXd::Ones(n + 1);
    a(n, n) = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Point3& p = data[std::size_t(i)];
        for (Eigen::Index j = 0; j < n; ++j)
            a(i, j) = gamma(p.x - data[std::size_t(j)].x, p.y - data[std::size_t(j)].y);
        a(i, i) -= v.nugget; // noise of the datum
        b[i] = gamma(p.x - x, p.y - y);
    }
    const Eigen::VectorXd w = a.fullPivLu().solve(b);
    Estimate e;
    for (Eigen::Index i = 0; i < n; ++i) e.value += w[i] * data[std::size_t(i)].z;
    e.standard_deviation = std::sqrt(std::max(w.dot(b), 0.0));
    return e;
}

} // namespace

TEST_CASE("kriging: estimates and variances agree with the textbook system", "[kriging]") {
    Random random(8);
    for (const auto model : {VariogramModel::spherical, VariogramModel::exponential,
                             VariogramModel::gaussian, VariogramModel::power})
        for (int n = 0; n < cases(6); ++n) {
            auto data = scattered(random, 25, 100);
            for (Point3& p : data) p.z = random_real(random, -5, 5);
            const Variogram v{model, n % 2 == 0 ? 0.5 : 0.05, 6, 60, 1.2, 30, n % 3 == 0 ? 1 : 0.5};
            const System kriging(data, v, 0); // a constant does not change the estimate
            for (int k = 0; k < 10; ++k) {
                const double x = random_real(random, 0, 100), y = random_real(random, 0, 100);
                const Estimate e = at(kriging, x, y), book = by_the_book(data, v, x, y);
                CHECK(e.value == Approx(book.value).margin(1e-6));
                CHECK(e.standard_deviation == Approx(book.standard_deviation).margin(1e-5));
            }
        }
}

TEST_CASE("kriging: without a nugget data are interpolated, planes and quadratics reproduced",
          "[kriging]") {
    Random random(9);
    auto data = scattered(random, 200, 100);
    const auto plane = [](double x, double y) { return 3 + 0.2 * x - 0.7 * y; };
    const auto bowl = [](double x, double y) { return 0.01 * x * x - 0.02 * x * y + y; };
    for (Point3& p : data) p.z = random_real(random, -5, 5);
    const Variogram v{VariogramModel::spherical, 0, 6, 60};
    const System rough(data, v, 1);
    for (const Point3& p : data) {
        CHECK(at(rough, p.x, p.y).value == Approx(p.z).margin(1e-6));
        CHECK(at(rough, p.x, p.y).standard_deviation < 1e-4);
    }
    for (Point3& p : data) p.z = plane(p.x, p.y);
    const System flat(data, v, 1);
    for (Point3& p : data) p.z = bowl(p.x, p.y);
    const System curved(data, v, 2);
    for (int k = 0; k < 20; ++k) {
        const double x = random_real(random, -50, 150), y = random_real(random, -50, 150);
        CHECK(at(flat, x, y).value == Approx(plane(x, y)).margin(1e-9));
        CHECK(at(curved, x, y).value == Approx(bowl(x, y)).margin(1e-8));
    }
}

TEST_CASE("kriging: the variance predicts the error for fields with this variogram", "[kriging]") {
    Random random(10);
    const Variogram v{VariogramModel::exponential, 0.2, 5, 50};
    double errors = 0, expected = 0;
    for (int n = 0; n < 40; ++n) {
        auto points = scattered(random, 90, 100);
        draw_heights(random, points, v);
        const std::vector<Point3> data(points.begin(), points.begin() + 70);
        const System kriging(data, v, 0);
        for (std::size_t k = 70; k < points.size(); ++k) {
            const Estimate e = at(kriging, points[k].x, points[k].y);
            errors += std::pow(e.value - points[k].z, 2);
            expected += e.standard_deviation * e.standard_deviation + v.nugget;
        }
    }
    CHECK(errors / expected == Approx(1).epsilon(0.15));
}

TEST_CASE("kriging: coincident data, nearly coincident data and a single datum are handled",
          "[kriging]") {
    Random random(12);
    auto data = scattered(random, 40, 100);
    for (Point3& p : data) p.z = random_real(random, -5, 5);
    const auto once = data;
    for (std::size_t i = 0; i < 20; ++i) {
        data.push_back(once[i]);
        data.push_back({once[i].x + 1e-9, once[i].y, once[i].z});
    }
    const Variogram v{VariogramModel::gaussian, 0, 6, 60};
    const System plain(once, v, 0), repeated(data, v, 0);
    const auto bound = [](double d) { return std::isfinite(d) && std::abs(d) < 1000; };
    for (int k = 0; k < 30; ++k) {
        const double x = random_real(random, 0, 100), y = random_real(random, 0, 100);
        CHECK(bound(at(repeated, x, y).value));
        CHECK(at(repeated, x, y).standard_deviation >= 0);
    }
    const std::vector<Point3> one{{1, 2, 3}};
    CHECK(at(System(one, v, 1), 50, 50).value == Approx(3));
}

TEST_CASE("kriging: data that are left out are missed as a system without them misses them",
          "[kriging]") {
    Random random(13);
    auto data = scattered(random, 30, 100);
    for (Point3& p : data) p.z = random_real(random, -5, 5);
    for (const Variogram& v : {Variogram{VariogramModel::exponential, 0.3, 6, 60},
                               Variogram{VariogramModel::cubic, 0.3, 6, 60}}) {
        const System all(data, v, 1),
            fewer(std::vector<Point3>(data.begin() + 5, data.end()), v, 1);
        const Eigen::MatrixXd projection = all.projection();
        const Eigen::MatrixXd covariance = projection.topLeftCorner(5, 5).inverse();
        const Eigen::VectorXd missed = covariance * all.weights().head(5);
        for (Eigen::Index i = 0; i < 5; ++i) {
            const Point3& p = data[std::size_t(i)];
            const auto [value, deviation] = at(fewer, p.x, p.y);
            CHECK(missed[i] == Approx(p.z - value).epsilon(1e-6));
            CHECK(covariance(i, i) == Approx(deviation * deviation + v.nugget).epsilon(1e-6));
        }
    }
}

TEST_CASE("kriging: likelihoods of trends of several degrees compare", "[kriging]") {
    Random random(14);
    std::normal_distribution<double> normal;
    for (const unsigned truth : {0U, 1U, 2U}) {
        auto data = scattered(random, 120, 100);
        for (Point3& p : data)
            p.z =
                (truth > 0 ? 0.1 * p.x : 0) + (truth > 1 ? 0.004 * p.x * p.y : 0) + normal(random);
        const auto all = Likelihood(data).of_noise();
        REQUIRE(all.size() == 3);
        for (unsigned degree = 0; degree < 3; ++degree) {
            CHECK(all[degree].degree == degree);
            CHECK((degree == truth || all[degree].likelihood < all[truth].likelihood));
        }
        CHECK(all[truth].variogram.nugget == Approx(1).epsilon(0.4));
    }
    // Noise alone is the limit of a field that is mostly noise.
    auto data = scattered(random, 120, 100);
    for (Point3& p : data) p.z = normal(random);
    const Likelihood likelihood(data);
    const auto with = likelihood.at({VariogramModel::exponential, 0, 1, 50}),
               none = likelihood.of_noise();
    REQUIRE(with.size() == 3);
    for (std::size_t degree = 0; degree < 3; ++degree) {
        CHECK(with[degree].degree == degree);
        CHECK(with[degree].likelihood > none[degree].likelihood - 0.1);
        CHECK(with[degree].likelihood < none[degree].likelihood + 5);
    }
    CHECK(likelihood.at({VariogramModel::cubic, 0, 1, 50}).size() == 2); // needs a trend
    for (Point3& p : data) p.z = 2 * p.x;
    const auto plane = Likelihood(data).of_noise();
    REQUIRE(plane.size() == 1);
    CHECK(plane[0].degree == 1);
    CHECK(plane[0].variogram.nugget == 0);
}
