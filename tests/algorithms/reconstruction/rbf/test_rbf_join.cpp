// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks graphs, which are filled exactly up to their border, and cliffs, whose triangles are
// longer than those around them.
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

#include <algorithm>
#include <cmath>
#include <span>

#include <catch2/catch.hpp>

#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>

using namespace terrane;
using namespace test_support;

TEST_CASE("rbf: a hole across a cliff is joined with points on its edges", "[rbf][once]") {
    const Surface s = cliff(250); // too steep to be fitted as heights
    const auto hole = hole_of(s);
    const auto alone = fill_by_rbf(s, hole);
    REQUIRE(alone);
    const auto not_joined = join_filling(s, hole, alone.value().surface);
    REQUIRE(!not_joined); // the level deviates from the cliff between its ends
    CHECK(not_joined.error().code == ErrorCode::not_closed);
    const auto filled = fill_and_join_by_rbf(s, hole);
    REQUIRE(filled);
    CHECK(check(std::span(&filled.value().joined.surface, 1)).value().clean());
    CHECK(filled.value().filling.report.model.find("long edges") != std::string::npos);
    for (const Point3& p : filled.value().joined.surface.vertices) {
        CHECK(p.z > -40);
        CHECK(p.z < 290);
    }
    // If the first attempt can be joined, there is no second one.
    for (const double lift : {5.0, 60.0}) {
        const Surface plain = cliff(lift);
        const auto once = fill_and_join_by_rbf(plain, hole_of(plain));
        REQUIRE(once);
        CHECK(once.value().filling.report.model.find("long edges") == std::string::npos);
        CHECK(check(std::span(&once.value().joined.surface, 1)).value().clean());
        for (const Point3& p : once.value().joined.surface.vertices) {
            CHECK(p.z > -40);
            CHECK(p.z < 40 + lift);
        }
    }
    std::stop_source stop;
    stop.request_stop();
    CHECK(fill_and_join_by_rbf(s, hole, {}, {}, {.stop = stop.get_token()}).error().code ==
          ErrorCode::interrupted);
}

TEST_CASE("rbf: graphs are filled up to their border, folds and occupied holes are joined",
          "[rbf][once]") {
    const auto wave = [](double x, double y) { return 0.5 * std::sin(x) * std::cos(0.7 * y); };
    const Surface s = punched(sheet(graph(wave), 0, 0, 10, 10, 36, 36, 0.2), disk(5.2, 4.9, 1.4));
    const auto filled = fill_and_join_by_rbf(s, hole_of(s));
    REQUIRE(filled);
    const auto& [filling, made, report] = filled.value();
    CHECK(filling.exact_border);
    CHECK(holes_of(made.surface).empty());
    CHECK(check(std::span(&made.surface, 1)).value().clean());
    REQUIRE(made.surface.vertices.size() > s.vertices.size());
    CHECK(std::equal(s.vertices.begin(), s.vertices.end(), made.surface.vertices.begin()));
    CHECK(std::equal(s.triangles.begin(), s.triangles.end(), made.surface.triangles.begin()));
    CHECK(made.filling_vertices.size() == made.surface.vertices.size() - s.vertices.size());
    CHECK(made.report.new_triangles == made.surface.triangles.size() - s.triangles.size());
    for (std::size_t k = 0; k < made.filling_vertices.size(); ++k) {
        const Point3& p = made.surface.vertices[s.vertices.size() + k];
        CHECK(filling.surface.vertices[made.filling_vertices[k]] == p);
        CHECK(filling.expected_error[made.filling_vertices[k]] > 0);
        CHECK(p.z == Approx(wave(p.x, p.y)).margin(0.01));
    }
    // Surfaces in the hole are never crossed.
    Surface occupied = s;
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    occupied.vertices.insert(occupied.vertices.end(), {{5, 5, -3}, {5.4, 5, -3}, {5.2, 5.1, 3}});
    occupied.triangles.push_back({first, first + 1, first + 2});
    const auto hole = holes_of(occupied).at(0);
    const auto crossed = fill_and_join_by_rbf(occupied, hole);
    REQUIRE(!crossed);
    CHECK(crossed.error().code == ErrorCode::improper_contact);
    // An upright sheet is no graph over x and y, but over its own plane.
    Surface upright = s;
    for (Point3& p : upright.vertices) p = {p.x, p.z, p.y};
    const auto turned = fill_and_join_by_rbf(upright, hole_of(upright));
    REQUIRE(turned);
    CHECK(turned->filling.exact_border);
    CHECK(turned->filling.report.expected_error > 0);
    const Surface& whole = turned->joined.surface;
    CHECK(std::equal(upright.vertices.begin(), upright.vertices.end(), whole.vertices.begin()));
    CHECK(holes_of(whole).empty());
    CHECK(check(std::span(&whole, 1)).value().clean());
    for (auto v = upright.vertices.size(); v < whole.vertices.size(); ++v)
        CHECK(whole.vertices[v].y ==
              Approx(wave(whole.vertices[v].x, whole.vertices[v].z)).margin(0.01));
}
