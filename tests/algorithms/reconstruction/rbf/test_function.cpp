// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks interpolation in space and its zero level.
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stop_token>

#include <catch2/catch.hpp>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/patches.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

using namespace terrane;
using namespace terrane::rbf::detail;

namespace {

std::vector<Point3> random_points(std::size_t n, unsigned seed, double scale = 1, Point3 at = {}) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> x(-scale, scale);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < n; ++i)
        points.push_back({at.x + x(random), at.y + x(random), at.z + x(random)});
    return points;
}

template <class F>
std::vector<double> values_at(const std::vector<Point3>& points, const F& f) {
    std::vector<double> values;
    for (const Point3& p : points) values.push_back(f(p));
    return values;
}

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
        const auto flat =
            fit_rbf(points, values_at(points, [&](const Point3& p) { return linear(local(p)); }));
        REQUIRE(flat);
        for (const Point3& p : random_points(50, 2, 100, at))
            CHECK(flat.value().function(p) == Approx(linear(local(p))).margin(1e-6));
        const auto wanted = values_at(points, [&](const Point3& p) { return smooth(local(p)); });
        const auto curved = fit_rbf(points, wanted);
        REQUIRE(curved);
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK(curved.value().function(points[i]) == Approx(wanted[i]).margin(1e-8));
        CHECK(curved.value().solution.centres == points.size());
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
    const auto fit = fit_rbf(points, values_at(points, f), {turned});
    REQUIRE(fit);
    for (const Point3& p : random_points(50, 4, 2))
        CHECK(fit.value().function(p) == Approx(f(p)).margin(1e-9));
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
        const auto fit = fit_rbf(points, values_at(points, f), {basis});
        REQUIRE(fit);
        for (const Point3& p : random_points(50, 14, 2))
            CHECK(fit.value().function(p) == Approx(f(p)).margin(1e-8));
    }
}

TEST_CASE("rbf: the gradient agrees with differences of values", "[rbf]") {
    const auto points = random_points(120, 5, 10);
    const bool in_space = GENERATE(false, true);
    const RbfPolynomial turned{2, {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}}}, in_space};
    const auto fit = fit_rbf(points, values_at(points, smooth), {turned});
    REQUIRE(fit);
    const auto& f = fit.value().function;
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

TEST_CASE("rbf: refinement lowers the residual of an ill-conditioned system", "[rbf]") {
    auto points = random_points(100, 7);
    for (std::size_t i = 0; i < 100; ++i) // pairs of points very near to each other
        points.push_back({points[i].x + 1e-4, points[i].y, points[i].z});
    const auto values = values_at(points, smooth);
    const auto fit = fit_rbf(points, values);
    REQUIRE(fit);
    CHECK(fit.value().solution.condition > 1e11);
    CHECK(fit.value().solution.refinements > 0);
    CHECK(fit.value().solution.residual < fit.value().solution.first_residual);
    CHECK(fit.value().solution.residual < 1e-9);
    const auto plain = fit_rbf(points, values, {{}, 0});
    REQUIRE(plain);
    CHECK(std::isnan(plain.value().solution.residual));
    // The reported residual is the error of the function, up to rounding in its evaluation.
    double missed = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        missed = std::max(missed, std::fabs(fit.value().function(points[i]) - values[i]));
    CHECK(missed < 1e-6);
}

TEST_CASE("rbf: points that can't be fitted are refused", "[rbf]") {
    const auto code = [](const std::vector<Point3>& points, unsigned degree = 1) {
        const auto fit = fit_rbf(points, std::vector<double>(points.size(), 1.0), {{degree}});
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
    const auto stopped = fit_rbf(points, values_at(points, smooth), {}, run);
    REQUIRE(!stopped);
    CHECK(stopped.error().code == ErrorCode::interrupted);
}

TEST_CASE("rbf: patches interpolate any number of values and fade away from them", "[rbf]") {
    CHECK(RbfPatches()({1, 2, 3}) == 0);
    for (const std::size_t n : {1U, 2U, 49U, 8000U}) {
        auto points = random_points(n, 9, 10);
        for (Point3& p : points) p.z = 0.2 * std::sin(p.x); // on a surface, as data are
        const auto values = values_at(points, [](const Point3& p) { return std::cos(p.x * p.y); });
        const RbfPatches patches(points, values);
        CHECK(patches.size() >= n / 48);
        double missed = 0;
        for (std::size_t i = 0; i < n; ++i)
            missed = std::max(missed, std::fabs(patches(points[i]) - values[i]));
        CHECK(missed < 1e-9);
        CHECK(patches({0, 0, 100}) == 0);
    }
}

TEST_CASE("zero level: a sphere is a closed manifold of good triangles", "[rbf]") {
    const Point3 centre{100.3, -20.1, 7};
    const auto r = [&](const Point3& p) {
        return std::hypot(p.x - centre.x, p.y - centre.y, p.z - centre.z);
    };
    const SpaceFunction sphere{[&](const Point3& p) { return r(p) - 2; },
                               [&](const Point3& p) {
                                   return Point3{(p.x - centre.x) / r(p), (p.y - centre.y) / r(p),
                                                 (p.z - centre.z) / r(p)};
                               }};
    const std::array seeds{Point3{centre.x + 2, centre.y, centre.z},
                           Point3{centre.x - 2, centre.y, centre.z}};
    ZeroLevelOptions options;
    options.size = 0.2;
    options.seeds = seeds;
    const auto level = zero_level(sphere, options);
    REQUIRE(level);
    const Surface& s = level.value();
    std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> uses;
    double six_volumes = 0, edges = 0;
    for (const Triangle& t : s.triangles) {
        for (unsigned k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            ++uses[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
            const Point3 &p = s.vertices[a], &q = s.vertices[b];
            edges += std::hypot(p.x - q.x, p.y - q.y, p.z - q.z) /
                     static_cast<double>(3 * s.triangles.size());
        }
        const auto at = [&](unsigned k) {
            const Point3& p = s.vertices[t[k]];
            return Point3{p.x - centre.x, p.y - centre.y, p.z - centre.z};
        };
        const Point3 a = at(0), b = at(1), c = at(2);
        six_volumes += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                       a.z * (b.x * c.y - b.y * c.x);
    }
    for (const auto& [edge, use] : uses) CHECK(use == std::array{1, 1});
    CHECK(s.vertices.size() + s.triangles.size() == uses.size() + 2);
    CHECK(six_volumes / 6 == Approx(4 * std::acos(-1.0) / 3 * 8).epsilon(0.01));
    CHECK(edges == Approx(0.2).epsilon(0.2));
    for (const Point3& p : s.vertices) CHECK(r(p) == Approx(2).margin(1e-3));
    CHECK(check(std::span(&s, 1)).value().clean());

    options.leave = [&](const Point3& p) { return p.z > centre.z; };
    const auto half = zero_level(sphere, options, {.threads = 2});
    REQUIRE(half);
    CHECK(half.value().triangles.size() < s.triangles.size());
    CHECK(check(std::span(&half.value(), 1)).value().clean());
    CHECK(check(std::span(&half.value(), 1)).value().free_border_edges > 10);
}

TEST_CASE("zero level: nearly flat levels keep their vertices", "[rbf]") {
    // Nearly along the lattice vertices come in rows, all of which naive thinning would remove.
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int k = 0; k < 30; ++k) {
        const double a = 0.02 * any(random), b = 0.02 * any(random), c = 0.02 * any(random),
                     d = 0.2 * any(random);
        const SpaceFunction slope{[=](const Point3& p) {
                                      return p.z - d - a * p.x - b * p.y -
                                             c * (p.x * p.x + p.y * p.y);
                                  },
                                  [=](const Point3& p) {
                                      return Point3{-a - 2 * c * p.x, -b - 2 * c * p.y, 1};
                                  }};
        const std::array seeds{Point3{0, 0, 0}};
        ZeroLevelOptions options;
        options.size = 0.5;
        options.seeds = seeds;
        options.leave = [](const Point3& p) { return std::hypot(p.x, p.y) > 4; };
        const auto level = zero_level(slope, options);
        REQUIRE(level);
        const Surface& s = level.value();
        double mean = 0, longest = 0;
        for (const Triangle& t : s.triangles)
            for (unsigned i = 0; i < 3; ++i) {
                const Point3 &p = s.vertices[t[i]], &q = s.vertices[t[(i + 1) % 3]];
                const double edge = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
                mean += edge / static_cast<double>(3 * s.triangles.size());
                longest = std::max(longest, edge);
            }
        CAPTURE(k);
        CHECK(mean > 0.7 * options.size);
        CHECK(mean < 1.1 * options.size);
        CHECK(longest < 2 * options.size);
    }
}

TEST_CASE("zero level: a function without zero level, or with too large a one, is an error",
          "[rbf]") {
    const SpaceFunction positive{[](const Point3&) { return 1.0; },
                                 [](const Point3&) { return Point3{}; }};
    const SpaceFunction plane{[](const Point3& p) { return p.z; },
                              [](const Point3&) {
                                  return Point3{0, 0, 1};
                              }};
    const std::array seeds{Point3{0, 0, 0.1}, Point3{100, 0, 0.1}};
    ZeroLevelOptions options;
    const auto code = [&](const SpaceFunction& f) { return zero_level(f, options).error().code; };
    CHECK(code(plane) == ErrorCode::bad_option);
    options.size = 1;
    CHECK(code(plane) == ErrorCode::bad_option);
    options.seeds = seeds;
    CHECK(code(positive) == ErrorCode::nothing_to_do);
    options.most_cubes = 100;
    CHECK(code(plane) == ErrorCode::unsupported);
    options.size = 1e-12;
    CHECK(code(plane) == ErrorCode::bad_option);
}
