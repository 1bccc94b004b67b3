// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/tolerance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace tolerance_test {

using namespace terrane;
using test_support::box;

namespace {

/// The blocks of surfaces, and the triangles that several of them have.
struct Found {
    std::vector<double> blocks;
    std::size_t shared = 0;
};

Found found_in(const std::vector<Surface>& surfaces) {
    const auto a = arrange(surfaces);
    REQUIRE(a);
    CHECK(a->statistics.improper_contacts == 0);
    const auto volumes = find_volumes(*a);
    REQUIRE(volumes);
    Found found;
    found.blocks.assign(volumes->measures.begin() + 1, volumes->measures.end());
    for (std::size_t t = 0; t < a->triangles.size(); ++t)
        if (a->surfaces_of[t].size() > 1) ++found.shared;
    return found;
}

JoinedSurfaces joined(const std::vector<Surface>& surfaces, double tolerance) {
    auto result = join_within(surfaces, {.tolerance = tolerance});
    REQUIRE(result);
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const Surface& now = result->surfaces[s];
        CHECK(now.name == surfaces[s].name);
        if (now.triangles.empty()) continue;
        CHECK(measured_distance(surfaces[s], now) <= tolerance);
        CHECK(measured_distance(now, surfaces[s]) <= tolerance);
    }
    return std::move(*result);
}

/// A bumpy sheet of n^2 squares over the square from 0 to 10.
Surface bumpy(std::string name, int n, double height) {
    Surface s{std::move(name), Role::unknown, {}, {}};
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            s.vertices.push_back(
                {10.0 * i / n, 10.0 * j / n, height * std::sin(7.0 * i + 3.0 * j)});
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            s.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            s.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return s;
}

} // namespace

TEST_CASE("tolerance: units with a gap or an overlap touch in a shared sheet", "[tolerance]") {
    const double misfit = GENERATE(0.003, -0.003, 1e-9);
    const std::vector<Surface> units{box({0, 0, 0}, {4, 4, 2}, "low"),
                                     box({0, 0.001, 2 + misfit}, {4.002, 4, 5}, "high")};
    const auto both = joined(units, 0.01);
    CHECK(both.report.is_joined);
    CHECK(both.report.left.empty());
    const Found found = found_in(both.surfaces);
    REQUIRE(found.blocks.size() == 2);
    CHECK(found.shared > 0);
    CHECK(found.blocks[0] == Approx(32).margin(0.01 * 64));
    CHECK(found.blocks[1] == Approx(48).margin(0.01 * 80));
}

TEST_CASE("tolerance: of three units each contact is between two of them", "[tolerance]") {
    // The two upper ones lie beside each other on the lower one, with a gap on each contact.
    const auto three =
        joined({box({0, 0, 0}, {4, 4, 2}, "low"), box({0, 0, 2.001}, {1.999, 4, 4}, "left"),
                box({2.0005, 0, 2.002}, {4, 4, 4}, "right")},
               0.01);
    const auto a = arrange(three.surfaces);
    REQUIRE(a);
    const auto volumes = find_volumes(*a);
    REQUIRE(volumes);
    CHECK(volumes->block_count() == 3);
    double contact[3] = {};
    for (std::uint32_t t = 0; t < a->triangles.size(); ++t) {
        const auto& [p, q, r] = a->triangles[t];
        const double area =
            area_between(a->nearest(VertexId(p)), a->nearest(VertexId(q)), a->nearest(VertexId(r)));
        const auto of = a->surfaces_of[t];
        CHECK(of.size() <= 2);
        if (of.size() == 2) contact[of[0] + of[1] - 1] += area;
    }
    CHECK(contact[0] == Approx(8).epsilon(0.01));
    CHECK(contact[1] == Approx(8).epsilon(0.01));
    CHECK(contact[2] == Approx(8).epsilon(0.01));
}

TEST_CASE("tolerance: open sheets side by side become one", "[tolerance]") {
    const auto both = joined({bumpy("a", 7, 0.01), bumpy("b", 5, 0.01)}, 0.1);
    const Found found = found_in(both.surfaces);
    CHECK(found.blocks.empty());
    CHECK(found.shared == both.surfaces[0].triangles.size());
    CHECK(both.surfaces[1].triangles.size() == found.shared);
}

TEST_CASE("tolerance: what is farther stays as it is", "[tolerance]") {
    const std::vector<Surface> units{box({0, 0, 0}, {4, 4, 2}, "low"),
                                     box({0, 0, 2.05}, {4, 4, 5}, "high")};
    const auto both = joined(units, 0.01);
    CHECK_FALSE(both.report.is_joined);
    for (std::size_t s = 0; s < 2; ++s) {
        CHECK(both.surfaces[s].vertices == units[s].vertices);
        CHECK(both.surfaces[s].triangles == units[s].triangles);
    }
}

TEST_CASE("tolerance: a unit that is thinner vanishes and is listed", "[tolerance]") {
    const std::vector<Surface> units{box({0, 0, 0}, {4, 4, 2}, "low"),
                                     box({0, 0, 2.001}, {4, 4, 2.011}, "thin"),
                                     box({0, 0, 2.012}, {4, 4, 5}, "high")};
    const auto without = joined(units, 0.1);
    CHECK(without.report.vanished == std::vector<std::uint32_t>{1});
    CHECK(found_in(without.surfaces).blocks.size() == 2);
    const auto with = joined(units, 0.004);
    CHECK(with.report.vanished.empty());
    CHECK(found_in(with.surfaces).blocks.size() == 3);
}

TEST_CASE("tolerance: ends of short edges that crossings leave are joined", "[tolerance]") {
    // The walls cross on the base 1e-6 beside its diagonal.
    const auto quad = [](std::string name, Point3 a, Point3 b, Point3 c, Point3 d) {
        return Surface{std::move(name), Role::unknown, {a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
    };
    const std::vector<Surface> surfaces{
        quad("base", {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}),
        quad("wall", {1e-6, -2, -1}, {1e-6, 2, -1}, {1e-6, 2, 2}, {1e-6, -2, 2}),
        quad("other", {-2, 0, -1}, {2, 0, -1}, {2, 0, 3}, {-2, 0, 3})};
    const auto shortest = [](const std::vector<Surface>& all) {
        const auto a = arrange(all);
        REQUIRE(a);
        double least = HUGE_VAL;
        for (const Triangle& t : a->triangles)
            for (std::size_t k = 0; k < 3; ++k)
                least = std::min(least, distance_between(a->nearest(VertexId(t[k])),
                                                         a->nearest(VertexId(t[(k + 1) % 3]))));
        return least;
    };
    CHECK(shortest(surfaces) < 2e-6);
    CHECK(shortest(joined(surfaces, 1e-3).surfaces) > 1e-3 / 64);
    // Edges that are longer than a 64th stay.
    const auto as_it_was = joined(surfaces, 1e-5);
    CHECK_FALSE(as_it_was.report.is_joined);
}

TEST_CASE("tolerance: the result does not depend on the number of threads", "[tolerance]") {
    const std::vector<Surface> units{box({0, 0, 0}, {4, 4, 2}, "low"), bumpy("sheet", 9, 0.01),
                                     box({0, 0, 2.003}, {4, 4, 5}, "high")};
    const auto one = join_within(units, {.tolerance = 0.02}, {.threads = 1});
    const auto four = join_within(units, {.tolerance = 0.02}, {.threads = 4});
    REQUIRE(one);
    REQUIRE(four);
    for (std::size_t s = 0; s < units.size(); ++s) {
        CHECK(one->surfaces[s].vertices == four->surfaces[s].vertices);
        CHECK(one->surfaces[s].triangles == four->surfaces[s].triangles);
    }
}

TEST_CASE("tolerance: no positive number is refused", "[tolerance]") {
    for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
        const auto refused = join_within({}, {.tolerance = bad});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::bad_option);
    }
    const auto nothing = join_within({}, {.tolerance = 1});
    REQUIRE(nothing);
    CHECK(nothing->surfaces.empty());
}

} // namespace tolerance_test
