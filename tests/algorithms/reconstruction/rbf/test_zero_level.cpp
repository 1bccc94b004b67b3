// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/zero_level.hpp>

#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <catch2/catch.hpp>

#include <terrane/algorithms/check/check.hpp>

#include "support/points.hpp"

using namespace terrane;
using namespace terrane::rbf::detail;
using namespace test_support;

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
