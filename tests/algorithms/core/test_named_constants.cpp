// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks that the constants of the stages can be listed for reports.
#include <terrane/algorithms/core/fields.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/triangulation/point_surface.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

using namespace terrane;

TEST_CASE("constants: each stage lists its constants once, by name", "[constants]") {
    for (const auto& list :
         {improve_constants(), hole_constants(), join_constants(), kriging_constants(),
          rbf_constants(), seal_constants(), extension_constants(), structure_constants(),
          rounding_constants(), boundary_constants(), point_constants(), tetrahedra_constants()}) {
        CHECK_FALSE(list.empty());
        std::set<std::string> names;
        for (const NamedConstant& c : list) {
            INFO(c.name);
            CHECK(names.insert(std::string(c.name)).second);
            CHECK(std::isfinite(c.value));
            CHECK(c.value != 0);
        }
    }
}

TEST_CASE("constants: the lists have the values that documents state", "[constants]") {
    const auto value = [](const std::vector<NamedConstant>& list, std::string_view name) {
        const auto at = std::find_if(list.begin(), list.end(),
                                     [&](const NamedConstant& c) { return c.name == name; });
        REQUIRE(at != list.end());
        return at->value;
    };
    CHECK(value(improve_constants(), "split_ratio") == 4.0 / 3);
    CHECK(value(improve_constants(), "window_size") == 256);
    CHECK(value(kriging_constants(), "most_places") == 20'000);
    CHECK(value(rbf_constants(), "left_out_width") == 0.25);
    CHECK(value(structure_constants(), "least_share") == 0.1);
    CHECK(value(rounding_constants(), "coarse_digits_6") == 32);
    CHECK(value(boundary_constants(), "most_named_sides") == 12);
    CHECK(value(point_constants(), "worth_tilting") == 0.8);
    CHECK(value(join_constants(), "strips_4") == 1.4);
    CHECK(value(tetrahedra_constants(), "least_ratio") == 1.1);
}
