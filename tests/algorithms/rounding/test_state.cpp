// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/state.hpp>

#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/soup_laws.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <utility>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

/// Returns a state in which all points are dirty and each triangle is its own parent.
RoundingState state_of(std::vector<Point3> points, std::vector<Triangle> triangles) {
    RoundingState state;
    state.move.assign(points.size(), 0);
    state.is_dirty.assign(points.size(), true);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) state.parents_of.push_back(std::array{t});
    state.points = std::move(points);
    state.triangles = std::move(triangles);
    return state;
}

} // namespace

TEST_CASE("rounding: triangles that became a line leave no corner inside their neighbours' sides") {
    // Two collapsed triangles lie between the side 0 3 above and the chain 0 1 2 3 below.
    auto state = state_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 2, 0}, {1, -2, 0}},
                          {{0, 3, 4}, {0, 2, 3}, {0, 1, 2}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}});
    state.is_dirty.assign(state.points.size(), false);
    state.is_dirty[2] = true;
    REQUIRE_FALSE(verify_conforming(state.points, state.triangles).empty());
    CHECK(state.tidy({}));
    CHECK(state.collapsed == 2);
    CHECK(state.triangles ==
          std::vector<Triangle>{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}});
    CHECK(state.parents_of.values == std::vector<std::uint32_t>{0, 0, 0, 3, 4, 5});
    CHECK(state.is_dirty[1]);
    CHECK(verify_conforming(state.points, state.triangles).empty());
    CHECK_FALSE(state.tidy({}));
}

TEST_CASE(
    "rounding: where the sides at collapsed triangles would multiply them, the mesh is torn") {
    // A line of collapsed triangles at the spine of a book.
    constexpr std::uint32_t pages = 12;
    for (const std::uint32_t steps : {4U, 40U}) {
        std::vector<Point3> points;
        std::vector<Triangle> triangles;
        for (std::uint32_t k = 0; k <= steps; ++k) points.push_back({double(k), 0, 0});
        for (std::uint32_t p = 0; p < pages; ++p) {
            triangles.push_back({0, steps, static_cast<std::uint32_t>(points.size())});
            points.push_back({1, double(p) - 5, 7});
        }
        for (std::uint32_t k = 1; k < steps; ++k) triangles.push_back({0, k, k + 1});
        auto state = state_of(points, triangles);
        CHECK(state.tidy({}));
        CHECK(state.collapsed == steps - 1);
        CHECK(state.is_torn == (steps == 40));
        if (state.is_torn)
            CHECK(state.triangles == std::vector(triangles.begin(), triangles.begin() + pages));
        else
            CHECK(state.triangles.size() == pages * steps);
    }
}

TEST_CASE("rounding: gaps are lines that collapsed triangles leave") {
    // Of each state triangle 0 remains, and the others are lines.
    SECTION("a line within a side of the triangle is no gap") {
        auto state = state_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {3, 0, 0}}, {{0, 1, 2}, {0, 3, 1}});
        CHECK(state.tidy({}));
        CHECK(state.total_gaps() == 0);
    }
    SECTION("a line between two triangles is up to half its length away") {
        auto state =
            state_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 5}, {8, 0, 5}, {0, 8, 5}, {0, 0, 0}},
                     {{0, 1, 2}, {3, 4, 5}, {0, 3, 6}});
        CHECK(state.tidy({}));
        CHECK(state.total_gaps() == Approx(2.5).epsilon(1e-12));
        CHECK(state.total_gaps() >= 2.5);
    }
    SECTION("a line that ends freely is up to its length away") {
        auto state = state_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 5}, {0, 0, 0}},
                              {{0, 1, 2}, {0, 3, 4}});
        CHECK(state.tidy({}));
        CHECK(state.total_gaps() == Approx(5).epsilon(1e-12));
        CHECK(state.total_gaps() >= 5);
    }
    SECTION("so are lines that are connected, with the sum of their lengths") {
        auto state =
            state_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 5}, {0, 0, 0}, {3, 0, 5}, {0, 0, 5}},
                     {{0, 1, 2}, {0, 3, 4}, {3, 5, 6}});
        CHECK(state.tidy({}));
        CHECK(state.total_gaps() == Approx(8).epsilon(1e-12));
        CHECK(state.total_gaps() >= 8);
    }
    SECTION("the next round adds them once") {
        auto state = state_of({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 5}, {0, 0, 0}},
                              {{0, 1, 2}, {0, 3, 4}});
        CHECK(state.tidy({}));
        const double before = state.total_gaps();
        state.end_round();
        CHECK(state.gaps == Approx(before).epsilon(1e-12));
        CHECK(state.total_gaps() == Approx(state.gaps).epsilon(1e-12));
    }
}

TEST_CASE("rounding: points that became equal are counted once, however often they are looked at") {
    auto state = state_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 2, 0}, {9, 9, 9}},
                          {{0, 1, 2}, {2, 3, 4}});
    CHECK(state.merged() == 0);
    CHECK(state.tidy({}));
    CHECK(state.merged() == 1); // 3 with 1; nothing uses the last point, but it is alone
    state.is_dirty.assign(state.points.size(), true);
    state.tidy({});
    CHECK(state.merged() == 1);
    CHECK(state.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 4}});
    state.drop_unused_points();
    CHECK(state.points.size() == 4);
}

TEST_CASE("rounding: what is equal once it is divided is one triangle with both parents") {
    auto state =
        state_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 2, 3}, {3, 1, 0}, {0, 1, 2}});
    CHECK(state.tidy({}));
    CHECK(state.triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
    CHECK(state.parents_of[0].size() == 2);
    CHECK(state.parents_of[1].size() == 1);
}
