// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks interpolation in space and its zero level.
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <cmath>
#include <stop_token>

#include <catch2/catch.hpp>

#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace test_support;
using namespace terrane::rbf::detail;

namespace {

double linear(const Point3& p) {
    return 3 - 2 * p.x + 0.5 * p.y + 7 * p.z;
}

double smooth(const Point3& p) {
    return std::sin(2 * p.x) + p.y * p.z;
}

} // namespace

TEST_CASE("rbf: values are interpolated, linear functions reproduced, also far from the origin",
          "[rbf]") {
    for (const Point3 at : {Point3{}, Point3{5e5, 6.2e6, -2000}}) {
        const auto points = random_points(150, 1, 40, at);
        const auto local = [&](const Point3& p) {
            return Point3{p.x - at.x, p.y - at.y, p.z - at.z};
        };
        const auto flat = RbfFunction::fitted(
            points, values_at(points, [&](const Point3& p) { return linear(local(p)); }));
        REQUIRE(flat);
        for (const Point3& p : random_points(50, 2, 100, at))
            CHECK((*flat)(p) == Approx(linear(local(p))).margin(1e-6));
        const auto wanted = values_at(points, [&](const Point3& p) { return smooth(local(p)); });
        const auto curved = RbfFunction::fitted(points, wanted);
        REQUIRE(curved);
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK((*curved)(points[i]) == Approx(wanted[i]).margin(1e-8));
    }
}

TEST_CASE("rbf: a higher degree reproduces polynomials along two axes", "[rbf]") {
    const auto points = random_points(200, 3);
    const double s = std::sqrt(0.5);
    const RbfPolynomial turned{3, {{{s, s, 0}, {0, 0, 1}, {s, -s, 0}}}}; // u, v, w
    const auto f = [&](const Point3& p) {
        const double u = s * (p.x + p.y), v = p.z, w = s * (p.x - p.y);
        return 1 + u * u * v - 2 * v * v * v + 0.3 * u - 4 * w;
    };
    const auto fit = RbfFunction::fitted(points, values_at(points, f), turned);
    REQUIRE(fit);
    for (const Point3& p : random_points(50, 4, 2)) CHECK((*fit)(p) == Approx(f(p)).margin(1e-9));
}

TEST_CASE("rbf: a polynomial in space is reproduced, a sphere or a fold among others", "[rbf]") {
    const auto points = random_points(200, 13);
    RbfPolynomial basis;
    basis.in_space = true;
    for (const unsigned degree : {1U, 2U, 3U, 4U}) {
        basis.degree = degree;
        CHECK(basis.terms() == std::size_t{degree + 1} * (degree + 2) * (degree + 3) / 6);
        const auto f = [&](const Point3& p) {
            return 1 - p.z + 2 * std::pow(p.x + 0.5 * p.y - 0.3 * p.z, degree) +
                   std::pow(p.z, degree);
        };
        const auto fit = RbfFunction::fitted(points, values_at(points, f), basis);
        REQUIRE(fit);
        for (const Point3& p : random_points(50, 14, 2))
            CHECK((*fit)(p) == Approx(f(p)).margin(1e-8));
    }
}

TEST_CASE("rbf: the gradient agrees with differences of values", "[rbf]") {
    const auto points = random_points(120, 5, 10);
    const bool in_space = GENERATE(false, true);
    const RbfPolynomial turned{2, {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}}}, in_space};
    const auto fit = RbfFunction::fitted(points, values_at(points, smooth), turned);
    REQUIRE(fit);
    const auto& f = *fit;
    for (const Point3& p : random_points(20, 6, 8)) {
        const double d = 1e-5;
        const Point3 g = f.gradient(p);
        CHECK(g.x == Approx((f({p.x + d, p.y, p.z}) - f({p.x - d, p.y, p.z})) / (2 * d))
                         .epsilon(1e-5)
                         .margin(1e-6));
        CHECK(g.y == Approx((f({p.x, p.y + d, p.z}) - f({p.x, p.y - d, p.z})) / (2 * d))
                         .epsilon(1e-5)
                         .margin(1e-6));
        CHECK(g.z == Approx((f({p.x, p.y, p.z + d}) - f({p.x, p.y, p.z - d})) / (2 * d))
                         .epsilon(1e-5)
                         .margin(1e-6));
    }
}

TEST_CASE("rbf: points that can't be fitted are refused", "[rbf]") {
    const auto code = [](const std::vector<Point3>& points, unsigned degree = 1) {
        const auto fit =
            RbfFunction::fitted(points, std::vector<double>(points.size(), 1.0), {degree});
        return fit ? ErrorCode::internal : fit.error().code;
    };
    auto points = random_points(30, 8);
    CHECK(code({points.begin(), points.begin() + 4}) == ErrorCode::bad_option);
    CHECK(code(points, 0) == ErrorCode::bad_option);
    CHECK(code(points, 7) == ErrorCode::bad_option);
    CHECK(code(std::vector<Point3>(30, Point3{1, 2, 3})) == ErrorCode::bad_option);
    auto flat = points;
    for (Point3& p : flat) p.z = 0;
    CHECK(code(flat) == ErrorCode::bad_option);
    auto twice = points;
    twice.push_back(points[3]);
    CHECK(code(twice) == ErrorCode::bad_option);
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const auto stopped = RbfFunction::fitted(points, values_at(points, smooth), {}, {}, run);
    REQUIRE(!stopped);
    CHECK(stopped.error().code == ErrorCode::interrupted);
}
