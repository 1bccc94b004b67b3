// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The report of rounding about input triangles of which nothing is left.
#include "support/points.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/detail/vanished.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace {

using namespace terrane;
using namespace test_support;

/// Returns the rounding of a sheet and a needle that crosses nothing, as if the needle had vanished.
RoundedMesh without_needle(const std::array<Point3, 3>& needle, double surface_deviation) {
    const std::vector<Surface> model{surface({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}),
                                     surface({needle[0], needle[1], needle[2]}, {{0, 1, 2}})};
    const auto a = arranged(model);
    RoundedMesh r = rounded(a);
    Mesh mesh = *r.mesh;
    REQUIRE(mesh.triangles.size() == 2);
    mesh.triangles.resize(1);
    mesh.parents_of = IndexLists<std::uint32_t>();
    mesh.parents_of.push_back(std::array{0U});
    r.mesh = std::move(mesh);
    r.report.vanished = rounding::detail::vanished(a, r.mesh->parents_of);
    REQUIRE(r.report.vanished == std::vector<std::uint32_t>{1});
    r.report.surface_deviation = r.report.deviation = surface_deviation;
    rounding::detail::state_vanished_length(a, r, {});
    CHECK(r.report.deviation >= r.report.surface_deviation + r.report.vanished_length);
    return r;
}

double lost(const std::array<Point3, 3>& needle, double surface_deviation) {
    return without_needle(needle, surface_deviation).report.vanished_length;
}

} // namespace

TEST_CASE("vanished: a needle beside the mesh has no lost length, any other its distance") {
    const double ulp = std::numeric_limits<double>::epsilon();
    const auto beside = [&](double z, double end) {
        return std::array<Point3, 3>{{{1, 1.5, z}, {end, 1.5, z}, {end, 1.5 + ulp, z}}};
    };
    // Doubles do not tell these apart: their coordinates are much larger.
    CHECK(lost(beside(0x1p-60, 5), 0x1.02p-60) == 0);
    CHECK(lost(beside(0x1p-60, 5), 0x1.fep-61) > 0);
    CHECK(lost(beside(0x1p-60, 5), 0x1.fep-61) < 1e-12);
    CHECK(lost(beside(-0x1p-60, 5), 0x1.02p-60) == 0);
    CHECK(lost(beside(-0x1p-60, 5), 0x1.fep-61) > 0);
    // Its tip is beyond the sheet, by 2^-.5 and 2^.5.
    for (const double beyond : {1., 2.}) {
        const double distance = beyond / std::sqrt(2.);
        CHECK(lost(beside(0x1p-60, 6.5 + beyond), 0x1p-59) >= distance);
        CHECK(lost(beside(0x1p-60, 6.5 + beyond), 0x1p-59) < 1.2 * distance);
        CHECK(lost(beside(0x1p-60, 6.5 + beyond), distance) > 0);
        CHECK(lost(beside(0x1p-60, 6.5 + beyond), 1.02 * distance) == 0);
    }
    // It stands on the sheet.
    const std::array<Point3, 3> upright{{{1, 1.5, 0x1p-60}, {1, 1.5, 4}, {1, 1.5 + ulp, 4}}};
    CHECK(lost(upright, 0x1p-50) >= 4);
    CHECK(lost(upright, 0x1p-50) < 4.8);
}

TEST_CASE("vanished: a needle over a gap of the mesh is lost there") {
    const double ulp = std::numeric_limits<double>::epsilon();
    const auto a = arranged({surface({{0, -9, 0}, {3, 0, 0}, {0, 9, 0}}, {{0, 1, 2}}),
                             surface({{10, -9, 0}, {10, 9, 0}, {4.5, 0, 0}}, {{0, 1, 2}}),
                             surface({{1, 0, 1}, {9, 0, 1}, {9, ulp, 1}}, {{0, 1, 2}})});
    RoundedMesh r = rounded(a);
    Mesh mesh = *r.mesh;
    REQUIRE(mesh.triangles.size() == 3);
    mesh.triangles.resize(2);
    mesh.parents_of = IndexLists<std::uint32_t>();
    for (const std::uint32_t parent : {0U, 1U}) mesh.parents_of.push_back(std::array{parent});
    r.mesh = std::move(mesh);
    r.report.vanished = {2};
    const auto lost_of = [&](double surface_deviation) {
        r.report.surface_deviation = surface_deviation;
        r.report.vanished_length = 0;
        rounding::detail::state_vanished_length(a, r, {});
        return r.report.vanished_length;
    };
    CHECK(lost_of(1.24) > 1.25); // the middle of the gap is .75 aside and 1 below
    CHECK(lost_of(1.26) == 0);
}

TEST_CASE("vanished: of what was cut out, only what was kept is lost") {
    const double ulp = std::numeric_limits<double>::epsilon(), high = 0x1p-20;
    // The tip of a needle is beyond a sheet, and beyond a wall in front of the sheet's border.
    auto a = arranged({surface({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}, {{0, 1, 2}}),
                       surface({{1, 1.5, high}, {9, 1.5, high}, {9, 1.5 + ulp, high}}, {{0, 1, 2}}),
                       surface({{5, 0, high / 2}, {5, 3, high / 2}, {5, 1.5, 4}}, {{0, 1, 2}})});
    RoundedMesh r;
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.parents_of.push_back(std::array{0U});
    r.mesh = std::move(mesh);
    r.report.vanished = {1};
    const auto lost_of = [&](double surface_deviation) {
        RoundedMesh copy = r;
        copy.report.surface_deviation = surface_deviation;
        rounding::detail::state_vanished_length(a, copy, {});
        return copy.report.vanished_length;
    };
    CHECK(lost_of(2 * high) > 1.7);
    own_state(a).whole = false;
    CHECK(lost_of(2 * high) > 1.7);
    std::vector<Triangle> kept;
    IndexLists<std::uint32_t> parents;
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
        const auto is_beyond = [&](std::uint32_t v) {
            return a.state->points.nearest(a.vertices[v]).x > 5.5;
        };
        if (a.parents_of[t][0] == 1 && std::ranges::any_of(a.triangles[t], is_beyond)) continue;
        kept.push_back(a.triangles[t]);
        parents.push_back(a.parents_of[t]);
    }
    REQUIRE(kept.size() < a.triangles.size());
    a.triangles = kept;
    a.parents_of = parents;
    CHECK(lost_of(2 * high) == 0);
    CHECK(lost_of(high / 2) > 0);
}

TEST_CASE(
    "vanished: needles that moving the input leaves without area are lost, or beside others") {
    const auto far =
        rounded(arranged(read_data("regression/019-needle-without-area-once-moved.obj")));
    REQUIRE(far.report.clean);
    CHECK(far.report.collapsed_triangles == 0);
    CHECK_FALSE(far.report.vanished.empty());
    CHECK(far.report.vanished_length > 2.77); // the triangle reaches so far from what is left
    CHECK(far.report.vanished_length < 4);
    const auto near =
        rounded(arranged(read_data("regression/020-needle-moved-onto-what-it-missed.obj")));
    REQUIRE(near.report.clean);
    CHECK_FALSE(near.report.vanished.empty());
    CHECK(near.report.vanished_length == 0);
}

TEST_CASE("vanished: where nothing would be left, there is an error") {
    // Three needles, the wide ends of which meet.
    const double below = std::nextafter(1., 0.), above = std::nextafter(1., 2.);
    const auto needle = [](const Point3& tip, const Point3& p, const Point3& q) {
        return surface({tip, p, q}, {{0, 1, 2}});
    };
    const auto a = arranged({needle({3, 2, 2}, {below, below, above}, {below, 1, above}),
                             needle({2, 3, 0}, {1, above, above}, {above, below, above}),
                             needle({2, 0, 3}, {1, above, 1}, {below, below, below})});
    const auto r = round_to_doubles(a);
    REQUIRE_FALSE(r);
    CHECK(r.error().code == ErrorCode::nothing_to_do);
}
