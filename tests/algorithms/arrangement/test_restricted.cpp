// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/arrangement/restricted.hpp>

#include <vector>

#include <catch2/catch.hpp>

#include "support/certified_inputs.hpp"
#include "support/cut_cases.hpp"
#include "support/points.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;
using namespace cut_cases;

TEST_CASE("restricted: keeping everything changes nothing, keeping nothing leaves nothing",
          "[voi]") {
    const auto a = arrange(std::vector{cube(0, 4), level(2, -1, -1, 5, 5)}).value();
    const Arrangement same = restricted(a, std::vector<bool>(a.triangles.size(), true));
    CHECK(same.triangles == a.triangles);
    CHECK(same.state->whole);
    const Arrangement none = restricted(a, std::vector<bool>(a.triangles.size(), false));
    CHECK(none.triangles.empty());
    CHECK(none.statistics.triangles == a.triangles.size()); // a part keeps the counts of the whole
    CHECK(none.statistics.vertices == a.vertices.size());
    CHECK(none.vertices.empty());
    CHECK_FALSE(none.state->whole);
    check_consistent(none);
    CHECK(find_volumes(none).value().block_count() == 0);
}

TEST_CASE("restricted: removing one surface leaves the arrangement of the others", "[voi]") {
    // The cube cuts the level; without the cube, its pieces are one region again.
    const auto a = arrange(std::vector{cube(0, 4), level(2, -1, -1, 5, 5)}).value();
    std::vector<bool> keep(a.triangles.size());
    for (std::size_t t = 0; t < keep.size(); ++t) keep[t] = a.surfaces_of[t][0] == 1;
    const Arrangement level_alone = restricted(a, keep);
    check_consistent(level_alone);
    CHECK(level_alone.intersection_edges.empty());
    const auto rounded = round_to_doubles(level_alone);
    REQUIRE(rounded);
    CHECK(rounded.value().report.clean);
    CHECK(rounded.value().regions.size() == 1);
    CHECK(rounded.value().regions[0].area == Approx(36));
}
