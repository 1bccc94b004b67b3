// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks cliffs, whose triangles are longer than those around them.
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

#include <catch2/catch.hpp>

#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>

using namespace terrane;
using namespace test_support;

namespace {} // namespace

TEST_CASE("rbf: a hole across a cliff is joined with points on its edges", "[rbf]") {
    const Surface s = cliff(60);
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
        CHECK(p.z < 100);
    }
    // If the first attempt can be joined, there is no second one.
    const Surface plain = cliff(5);
    const auto once = fill_and_join_by_rbf(plain, hole_of(plain));
    REQUIRE(once);
    CHECK(once.value().filling.report.model.find("long edges") == std::string::npos);
    std::stop_source stop;
    stop.request_stop();
    CHECK(fill_and_join_by_rbf(s, hole, {}, {}, {.stop = stop.get_token()}).error().code ==
          ErrorCode::interrupted);
}
