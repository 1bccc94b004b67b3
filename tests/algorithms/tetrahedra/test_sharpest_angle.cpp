// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/sharpest_angle.hpp>

#include <cmath>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

TEST_CASE("sharpest_angle: between triangles at an edge", "[tetrahedra]") {
    CHECK_FALSE(sharpest_angle(
        mesh_of({{"one", Role::unknown, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}})));
    const auto cube_angle = sharpest_angle(mesh_of({cube(0, 2)}));
    REQUIRE(cube_angle);
    CHECK(cube_angle->degrees == Approx(90));
    // A wedge of one degree on the edge from (0, 0, 0) to (4, 0, 0).
    const double rise = std::tan(std::acos(-1.0) / 180);
    const auto wedge = sharpest_angle(
        mesh_of({{"a", Role::unknown, {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}}, {{0, 1, 2}}},
                 {"b", Role::unknown, {{0, 0, 0}, {4, 0, 0}, {2, 3, 3 * rise}}, {{0, 1, 2}}}}));
    REQUIRE(wedge);
    CHECK(wedge->degrees == Approx(1));
    CHECK(wedge->place == Point3{2, 0, 0});
}
