// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>

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
            const Kriging kriging(data, v, 0); // a constant does not change the estimate
            for (int k = 0; k < 10; ++k) {
                const double x = random_real(random, 0, 100), y = random_real(random, 0, 100);
                const Estimate e = kriging.at(x, y), book = by_the_book(data, v, x, y);
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
    const Kriging rough(data, v);
    for (const Point3& p : data) {
        CHECK(rough.at(p.x, p.y).value == Approx(p.z).margin(1e-6));
        CHECK(rough.at(p.x, p.y).standard_deviation < 1e-4);
    }
    for (Point3& p : data) p.z = plane(p.x, p.y);
    const Kriging flat(data, v);
    for (Point3& p : data) p.z = bowl(p.x, p.y);
    const Kriging curved(data, v, 2);
    for (int k = 0; k < 20; ++k) {
        const double x = random_real(random, -50, 150), y = random_real(random, -50, 150);
        CHECK(flat.at(x, y).value == Approx(plane(x, y)).margin(1e-9));
        CHECK(curved.at(x, y).value == Approx(bowl(x, y)).margin(1e-8));
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
        const Kriging kriging(data, v, 0);
        for (std::size_t k = 70; k < points.size(); ++k) {
            const Estimate e = kriging.at(points[k].x, points[k].y);
            errors += std::pow(e.value - points[k].z, 2);
            expected += e.standard_deviation * e.standard_deviation + v.nugget;
        }
    }
    CHECK(errors / expected == Approx(1).epsilon(0.15));
}

TEST_CASE("kriging: neighbours give nearly the same estimates as all data at once", "[kriging]") {
    const auto z = [](double x, double y) { return 10 * std::sin(x / 20) + y * std::cos(x / 30); };
    std::vector<Point3> few, many;
    for (int i = 0; i <= 25; ++i)
        for (int j = 0; j <= 25; ++j) few.push_back({4.0 * i, 4.0 * j, z(4.0 * i, 4.0 * j)});
    const double step = 100.0 / 60;
    for (int i = 0; i <= 60; ++i)
        for (int j = 0; j <= 60; ++j)
            if (std::hypot(i - 30, j - 30) > 6)
                many.push_back({step * i, step * j, z(step * i, step * j)});
    REQUIRE(few.size() <= Kriging::most_at_once);
    REQUIRE(many.size() > Kriging::most_at_once);
    const Variogram v{VariogramModel::gaussian, 0, 100, 60};
    const Kriging all(few, v), local(many, v);
    for (const double x : {13.0, 41.0, 50.0, 57.0, 77.0})
        for (const double y : {20.5, 50.0, 53.0}) {
            CHECK(all.at(x, y).value == Approx(z(x, y)).margin(0.01));
            CHECK(local.at(x, y).value == Approx(z(x, y)).margin(0.05));
        }
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
    const Kriging plain(once, v, 0), repeated(data, v, 0);
    const auto bound = [](double d) { return std::isfinite(d) && std::abs(d) < 1000; };
    for (int k = 0; k < 30; ++k) {
        const double x = random_real(random, 0, 100), y = random_real(random, 0, 100);
        CHECK(bound(repeated.at(x, y).value));
        CHECK(repeated.at(x, y).standard_deviation >= 0);
    }
    const std::vector<Point3> one{{1, 2, 3}};
    CHECK(Kriging(one, v).at(50, 50).value == Approx(3));
}
