// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests what merging small blocks removes, and what it must leave alone.
#include <terrane/algorithms/model/arrange_within.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

using Corners = std::array<Point3, 3>;

Arrangement arrangement_of(const std::vector<Surface>& surfaces) {
    auto a = arrange(surfaces);
    REQUIRE(a);
    return std::move(*a);
}

std::vector<double> volumes_in(const Arrangement& a) {
    const auto volumes = find_volumes(a);
    REQUIRE(volumes);
    return volumes->measures;
}

std::multiset<Corners> triangles_in(const Arrangement& a) {
    std::multiset<Corners> triangles;
    for (const Triangle& t : a.triangles) {
        Corners corners{};
        for (std::size_t k = 0; k < 3; ++k) corners[k] = a.state->points.nearest(a.vertices[t[k]]);
        triangles.insert(corners);
    }
    return triangles;
}

/// Merges, and checks the sentences that hold for any input: nothing is added, all triangles that
/// are missing are counted, no volume is lost, and no block that could be merged is small.
WithoutSmallBlocks merged(const std::vector<Surface>& surfaces, double least) {
    const Arrangement before = arrangement_of(surfaces);
    auto without = merge_small_blocks(before, least);
    REQUIRE(without);
    const auto all = triangles_in(before), left = triangles_in(without->arrangement);
    CHECK(std::includes(all.begin(), all.end(), left.begin(), left.end()));
    std::size_t removed = 0, small = 0;
    for (const MergedBlock& m : without->report.merged) {
        CHECK(m.volume < least);
        CHECK(m.triangles > 0);
        CHECK(m.thickness > 0);
        removed += m.triangles;
    }
    CHECK(all.size() - left.size() == removed);
    const auto old = volumes_in(before), now = volumes_in(without->arrangement);
    CHECK(now.size() - 1 + without->report.merged.size() == old.size() - 1);
    for (std::size_t b = 1; b < now.size(); ++b) small += now[b] < least ? 1 : 0;
    CHECK(small == without->report.kept);
    const auto rounded = round_to_doubles(without->arrangement);
    REQUIRE(rounded);
    CHECK(rounded->report.clean);
    return std::move(*without);
}

Surface boundary_box(double high) {
    Surface sides = box({0, 0, 0}, {8, 8, high});
    sides.role = Role::boundary;
    return sides;
}

/// Sheets through the box that cross each other often, a thousandth apart.
std::vector<Surface> nearly_equal_sheets() {
    const auto height = [](double u, double v) {
        return 0.001 * std::sin(40 * u) * std::cos(37 * v);
    };
    return {boundary_box(8),
            unit_grid(
                12, 12,
                [](double u, double v) {
                    return Point3{8 * u, 8 * v, 4};
                },
                "flat"),
            unit_grid(
                12, 12,
                [&](double u, double v) {
                    return Point3{8 * u, 8 * v, 4 + height(u, v)};
                },
                "wavy")};
}

} // namespace

TEST_CASE("small blocks: slivers between nearly equal sheets become part of the blocks beside them",
          "[volumes]") {
    const auto surfaces = nearly_equal_sheets();
    const auto before = volumes_in(arrangement_of(surfaces));
    REQUIRE(before.size() > 20);
    const auto without = merged(surfaces, 1);
    const auto after = volumes_in(without.arrangement);
    REQUIRE(after.size() == 3); // the sheets still part the box: no hole was torn
    CHECK(after[1] + after[2] == Approx(512).epsilon(1e-14));
    CHECK(after[1] == Approx(256).epsilon(1e-3));
    CHECK(without.report.merged.size() == before.size() - 3);
    CHECK(without.report.kept == 0);
    for (std::size_t i = 1; i < without.report.merged.size(); ++i)
        CHECK(without.report.merged[i].surfaces.size() == 1);
    for (const MergedBlock& m : without.report.merged) {
        CHECK(m.thickness < 0.002);
        CHECK(std::fabs(m.place.z - 4) < 0.002);
        CHECK(m.into > m.volume);
    }
}

TEST_CASE("small blocks: a sliver with one block on all sides leaves one of its sheets whole",
          "[volumes]") {
    // Two sheets that end inside of the box and meet along their borders.
    const auto lens = [](double lift, const char* name) {
        return unit_grid(
            8, 8,
            [lift](double u, double v) {
                const double inside = u * (1 - u) * v * (1 - v);
                return Point3{2 + 4 * u, 2 + 4 * v, 4 + lift * inside};
            },
            name);
    };
    const std::vector<Surface> surfaces{boundary_box(8), lens(0, "lower"), lens(0.01, "upper")};
    const auto without = merged(surfaces, 0.1);
    REQUIRE(without.report.merged.size() == 1);
    const MergedBlock& m = without.report.merged[0];
    REQUIRE(m.surfaces.size() == 1);
    CHECK(m.surfaces[0] == 2); // its area is a little larger
    CHECK(m.triangles == 126); // two corner triangles are common to both sheets, and stay
    CHECK(volumes_in(without.arrangement) == std::vector<double>{HUGE_VAL, 512});
    std::size_t lower = 0;
    for (std::size_t t = 0; t < without.arrangement.triangles.size(); ++t)
        lower += std::ranges::count(without.arrangement.surfaces_of[t], 1U) > 0 ? 1 : 0;
    CHECK(lower == 128);
}

TEST_CASE("small blocks: the boundary of a model stays", "[volumes]") {
    SECTION("a sheet close to the bottom is removed, not the bottom") {
        const auto without = merged({boundary_box(8), level(0.001, -1, -1, 9, 9, "sheet")}, 1);
        REQUIRE(without.report.merged.size() == 1);
        CHECK(without.report.merged[0].surfaces == std::vector<std::uint32_t>{1});
        CHECK(volumes_in(without.arrangement) == std::vector<double>{HUGE_VAL, 512});
    }
    SECTION("a model that is small itself") {
        const auto without = merged({boundary_box(0.001)}, 1);
        CHECK(without.report.merged.empty());
        CHECK(without.report.kept == 1);
    }
    SECTION("a small body outside of all others") {
        const auto without = merged({cube(0, 8), cube(20, 20.125)}, 1);
        REQUIRE(without.report.merged.size() == 1);
        CHECK(without.report.merged[0].into == std::numeric_limits<double>::infinity());
        CHECK(volumes_in(without.arrangement) == std::vector<double>{HUGE_VAL, 512});
    }
}

TEST_CASE("small blocks: what is merged counts as one block", "[volumes]") {
    std::vector<Surface> surfaces{boundary_box(8)};
    for (const double z : {4.0, 4.25, 4.5, 4.75})
        surfaces.push_back(level(z, -1, -1, 9, 9, "sheet"));
    // Layers of 16 between blocks of 256 and 208: two are enough for 30, all are too few for 50.
    CHECK(merged(surfaces, 16).report.merged.empty());
    const auto pairs = merged(surfaces, 30);
    CHECK(volumes_in(pairs.arrangement).size() - 1 >= 2);
    CHECK(pairs.report.merged.size() <= 3);
    const auto all = merged(surfaces, 50);
    CHECK(volumes_in(all.arrangement).size() - 1 == 2);
    CHECK(all.report.merged.size() == 3);
}

TEST_CASE("small blocks: nothing changes where no block is small", "[volumes]") {
    const Arrangement before = arrangement_of({cube(0, 8), cube(4, 12)});
    const auto without = merge_small_blocks(before, 63.9);
    REQUIRE(without);
    CHECK(without->report.merged.empty());
    CHECK(without->arrangement.triangles == before.triangles);
    CHECK(without->arrangement.state->whole);
    const auto exact = merge_small_blocks(before, 64); // "below" is exact
    REQUIRE(exact);
    CHECK(exact->report.merged.empty());
    const auto more = merge_small_blocks(before, std::nextafter(64.0, 65.0));
    REQUIRE(more);
    CHECK(more->report.merged.size() == 1);
}

TEST_CASE("small blocks: the volume must be positive and finite", "[volumes]") {
    const Arrangement before = arrangement_of({cube(0, 8)});
    for (const double least : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
        const auto without = merge_small_blocks(before, least);
        REQUIRE_FALSE(without);
        CHECK(without.error().code == ErrorCode::bad_option);
    }
}

TEST_CASE("small blocks: merged again after a small move of the vertices", "[volumes]") {
    auto surfaces = nearly_equal_sheets();
    const auto without = merged(surfaces, 1);
    for (std::size_t s = 1; s < surfaces.size(); ++s)
        for (Point3& p : surfaces[s].vertices) p.z += 0x1p-40;
    REQUIRE(without.arrangement.state->restrict_again);
    const auto again = without.arrangement.state->restrict_again(arrangement_of(surfaces), {});
    REQUIRE(again);
    CHECK(volumes_in(*again).size() == 3);
    // The same after a cut, which is made again first.
    const std::vector<Surface> boundary{boundary_box(7)};
    const std::vector<Surface> sheets{surfaces[1], surfaces[2]};
    const auto cut = arrange_exactly_within(sheets, boundary, {.min_volume = 1});
    REQUIRE(cut);
    REQUIRE(cut->merged);
    CHECK_FALSE(cut->merged->merged.empty());
    REQUIRE(cut->exact.state->restrict_again);
    const auto moved =
        cut->exact.state->restrict_again(arrangement_of({sheets[0], sheets[1], boundary[0]}), {});
    REQUIRE(moved);
    CHECK(volumes_in(*moved) == volumes_in(cut->exact));
}

TEST_CASE("small blocks: the volume that is certainly dirt", "[volumes]") {
    const auto squares = [](double step) {
        return std::vector<Surface>{unit_grid(10, 10, [step](double u, double v) {
            return Point3{10 * step * u, 10 * step * v, 0};
        })};
    };
    CHECK(median_edge_length(squares(3)) == Approx(3));
    CHECK(small_volume_for(squares(3)) == Approx(0.027));
    CHECK(small_volume_for({}) == 0);
}
