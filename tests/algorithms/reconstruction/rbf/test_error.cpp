// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/error.hpp>

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/loops.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

namespace {

double cubed(const Point3& p, const Point3& q) {
    return std::pow(std::hypot(p.x - q.x, p.y - q.y, p.z - q.z), 3);
}

/// Interpolates by |p - q|^3 and 1, u, v with a dense system, independently of the library.
struct Plain {
    std::vector<Point3> centres;
    Eigen::VectorXd solution;

    Plain(std::vector<Point3> at, const Eigen::VectorXd& values) : centres(std::move(at)) {
        const auto n = static_cast<Eigen::Index>(centres.size());
        Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Point3& p = centres[std::size_t(i)];
            for (Eigen::Index j = 0; j < n; ++j) system(i, j) = cubed(p, centres[std::size_t(j)]);
            system.block(i, n, 1, 3) << 1, p.x, p.y;
            system.block(n, i, 3, 1) << 1, p.x, p.y;
        }
        Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
        right.head(n) = values;
        solution = system.fullPivLu().solve(right);
    }
    double operator()(const Point3& p) const {
        const auto n = static_cast<Eigen::Index>(centres.size());
        double sum = solution[n] + solution[n + 1] * p.x + solution[n + 2] * p.y;
        for (Eigen::Index i = 0; i < n; ++i) sum += solution[i] * cubed(p, centres[std::size_t(i)]);
        return sum;
    }
    /// Computes the root of the sum of c_i c_j |p_i - p_j|^3.
    [[nodiscard]] double energy() const {
        double sum = 0;
        for (std::size_t i = 0; i < centres.size(); ++i)
            for (std::size_t j = 0; j < centres.size(); ++j)
                sum += solution[Eigen::Index(i)] * solution[Eigen::Index(j)] *
                       cubed(centres[i], centres[j]);
        return std::sqrt(std::max(sum, 0.0));
    }
};

RbfData data_at(const std::vector<Point3>& points) {
    RbfData data;
    data.points = points;
    data.distances.assign(points.size(), 0);
    data.radius = 3;
    return data;
}

} // namespace

TEST_CASE("rbf: the power function bounds the error of each function, and one attains it",
          "[rbf]") {
    const auto points = random_points(40, 8, 5);
    const RbfError error(data_at(points), {}, 0, 0);
    const auto at_data = error.at(points, false, {});
    CHECK(*std::max_element(at_data.begin(), at_data.end()) < 1e-3);
    const auto places = random_points(8, 9, 5);
    const auto bounds = error.at(places, false, {});
    for (std::size_t k = 0; k < places.size(); ++k) {
        // Functions of finite energy, with centres that are no data.
        for (unsigned seed = 20; seed < 26; ++seed) {
            const auto centres = random_points(12, seed, 6);
            const Plain f(centres, Eigen::VectorXd::Random(12));
            Eigen::VectorXd values(40);
            for (Eigen::Index i = 0; i < 40; ++i) values[i] = f(points[std::size_t(i)]);
            const Plain interpolant(points, values);
            CHECK(std::fabs(f(places[k]) - interpolant(places[k])) <=
                  bounds[k] * f.energy() * (1 + 1e-6));
        }
        // The bound is attained by the function of least energy that is 1 there and 0 at the data.
        auto all = points;
        all.push_back(places[k]);
        Eigen::VectorXd values = Eigen::VectorXd::Zero(41);
        values[40] = 1;
        CHECK(bounds[k] * Plain(all, values).energy() == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("rbf: the power function scales, and grows with noise and with fewer data", "[rbf]") {
    const auto points = random_points(60, 10, 5), places = random_points(10, 11, 5);
    const auto plain = RbfError(data_at(points), {}, 0, 0).at(places, false, {});
    auto large = data_at(points);
    large.radius *= 4;
    auto far = places;
    for (auto* set : {&large.points, &far})
        for (Point3& p : *set) p = {4 * p.x, 4 * p.y, 4 * p.z};
    const auto scaled = RbfError(large, {}, 0, 0).at(far, false, {});
    const std::vector<Point3> half(points.begin(), points.begin() + 30);
    const auto fewer = RbfError(data_at(half), {}, 0, 0).at(places, false, {});
    const RbfError with_noise(data_at(points), {}, 0, 5);
    const auto noisy_data = with_noise.at(places, false, {}),
               measured = with_noise.at(places, true, {});
    for (std::size_t k = 0; k < places.size(); ++k) {
        CHECK(scaled[k] == Approx(8 * plain[k]).epsilon(1e-9));
        CHECK(fewer[k] > plain[k]);
        CHECK(noisy_data[k] > plain[k]);
        CHECK(measured[k] == Approx(std::sqrt(noisy_data[k] * noisy_data[k] + 5)));
    }
}
