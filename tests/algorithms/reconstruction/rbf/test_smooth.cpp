// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks smoothing of noisy data, by itself and in holes of known surfaces.
#include <cmath>
#include <random>
#include <span>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "support/loops.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

namespace {

double bump(const Point3& p) {
    return 3 * std::sin(p.x / 4) * std::cos(p.y / 5) + 0.1 * p.z;
}

/// Evaluates a function and adds noise of this standard deviation.
template <class F>
std::vector<double> noisy(const std::vector<Point3>& points, const F& f, double deviation) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> noise(0, 1);
    std::vector<double> values;
    for (const Point3& p : points) values.push_back(f(p) + deviation * noise(random));
    return values;
}

template <class F, class G>
double rms_between(const std::vector<Point3>& points, const F& f, const G& g) {
    double sum = 0;
    for (const Point3& p : points) sum += std::pow(f(p) - g(p), 2);
    return std::sqrt(sum / static_cast<double>(points.size()));
}

} // namespace

TEST_CASE("rbf: smoothing has the wanted error", "[rbf]") {
    const auto points = random_points(300, 1, 10);
    const auto values = noisy(points, bump, 0.3);
    for (const double wanted : {0.1, 0.25, 0.5, 1.0}) {
        const auto fit = RbfFunction::fitted(points, values, {}, wanted);
        REQUIRE(fit);
        std::size_t i = 0;
        double sum = 0;
        for (const Point3& p : points) sum += std::pow((*fit)(p)-values[i++], 2);
        CHECK(std::sqrt(sum / 300) == Approx(wanted).epsilon(1e-6));
    }
}

TEST_CASE("rbf: almost no smoothing is interpolation, and polynomials are not smoothed", "[rbf]") {
    const auto points = random_points(80, 2, 10), others = random_points(50, 3, 10);
    const auto values = noisy(points, bump, 0);
    const auto exact = RbfFunction::fitted(points, values);
    const auto nearly = RbfFunction::fitted(points, values, {}, 1e-9);
    REQUIRE(exact);
    REQUIRE(nearly);
    CHECK(rms_between(others, *exact, *nearly) < 1e-5);
    const RbfPolynomial degree_2{2, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    const auto parabola = [](const Point3& p) { return 1 + p.x * p.y - 0.5 * p.x * p.x + p.z; };
    for (const double wanted : {0.0, 0.01, 10.0}) {
        const auto fit = RbfFunction::fitted(points, noisy(points, parabola, 0), degree_2, wanted);
        REQUIRE(fit);
        CHECK(rms_between(others, parabola, *fit) < 1e-8);
    }
}

TEST_CASE("rbf: the likeliest smoothing is nearer the truth than interpolation", "[rbf]") {
    const auto points = random_points(400, 4, 10), others = random_points(200, 5, 8);
    for (const double deviation : {0.1, 0.5}) {
        const auto values = noisy(points, bump, deviation);
        const auto smooth = RbfFunction::fitted(points, values, {}, 0);
        const auto exact = RbfFunction::fitted(points, values);
        REQUIRE(smooth);
        REQUIRE(exact);
        const double ours = rms_between(others, bump, *smooth);
        CHECK(ours < 0.65 * rms_between(others, bump, *exact));
        CHECK(ours < 0.8 * deviation);
    }
}

TEST_CASE("rbf: noise of the data stays out of the hole, interpolated or smoothed", "[rbf][once]") {
    std::mt19937_64 random(12);
    std::normal_distribution<double> noise(0, 0.05);
    const auto height = [](double x, double y) { return std::sin(0.6 * x) + 0.2 * y; };
    Surface s = sheet(graph([&](double x, double y) { return height(x, y) + noise(random); }), 0, 0,
                      10, 10, 60, 60);
    s = punched(s, disk(5, 5, 2));
    const auto hole = hole_of(s);
    for (const std::optional<double>& smoothing :
         {std::optional<double>(), std::optional<double>(0.0), std::optional<double>(0.05)}) {
        RbfOptions options;
        options.smoothing = smoothing;
        options.most_centres = 400;
        RbfReport report;
        const auto filling = fill_by_rbf(s, hole, options, {}, &report);
        REQUIRE(filling);
        if (smoothing) {
            CHECK(report.largest_error == report.missed);
            CHECK(report.rms_error == Approx(0.05).epsilon(0.2));
        } else {
            CHECK(report.largest_error < 1e-10);
            RbfOptions again = options; // an option that was set and reset leaves no trace
            again.smoothing = 40.0;
            again.smoothing.reset();
            const auto same = fill_by_rbf(s, hole, again);
            REQUIRE(same);
            CHECK(same.value().surface.vertices == filling.value().surface.vertices);
        }
        const auto made = join_filling(s, hole, filling.value().surface);
        if (!made) FAIL(made.error().message());
        CHECK(check(std::span(&made.value().surface, 1)).value().clean());
        double sum = 0;
        for (std::size_t v = s.vertices.size(); v < made.value().surface.vertices.size(); ++v) {
            const Point3& p = made.value().surface.vertices[v];
            sum += std::pow(p.z - height(p.x, p.y), 2);
        }
        const double n = double(made.value().report.new_vertices);
        CHECK(std::sqrt(sum / n) < 0.05); // one sample's
    }
}
