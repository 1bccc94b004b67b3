// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/structure/structure.hpp>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/mesh/triangle_tree.hpp>

using namespace terrane;
using namespace test_support;

namespace {

std::vector<FreeBorder> borders_of(const std::vector<Surface>& surfaces) {
    const Mesh mesh = rounded(arranged(surfaces)).mesh;
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    return find_free_borders(mesh, build_structure(mesh, volumes.value()));
}

} // namespace

TEST_CASE("free borders: a fault that stops short of a horizon has gaps by distance", "[borders]") {
    // Its lower border from y = 0 to 10 is 0.5 above the horizon at one end, 1.5 at the other.
    const auto borders =
        borders_of({level(0, -20, -20, 20, 20, "horizon"),
                    quad({0, 0, 0.5}, {0, 10, 1.5}, {0, 10, 5}, {0, 0, 5}, "fault"),
                    level(100, -20, -20, 20, 20, "far")});
    REQUIRE(borders.size() == 3);
    const auto fault = std::find_if(borders.begin(), borders.end(),
                                    [](const FreeBorder& b) { return b.surfaces[0] == 1; });
    REQUIRE(fault != borders.end());
    CHECK(fault->closed);
    CHECK(fault->length == Approx(10 + std::hypot(10, 1) + 4.5 + 3.5));
    REQUIRE(fault->gaps.size() == 1);
    CHECK(fault->gaps[0].surface == 0);
    CHECK(fault->gaps[0].decade == 0);
    CHECK(fault->gaps[0].least == 1.5); // of the lower edge, at its farther end
    CHECK(fault->gaps[0].largest == 5);
    CHECK(fault->gaps[0].place.z == 5);
    CHECK(fault->gaps[0].length == Approx(fault->length));
    const auto leaks = leaks_of(borders);
    const auto leak =
        std::find_if(leaks.begin(), leaks.end(), [](const Leak& l) { return l.from == 1; });
    REQUIRE(leak != leaks.end());
    CHECK(leak->to == 0);
    CHECK(leak->borders == 1);
    CHECK(leak->least == 1.5);
}

TEST_CASE("free borders: a closed surface has none, and a single surface has no gaps",
          "[borders]") {
    CHECK(borders_of({cube(0, 1)}).empty());
    const auto alone = borders_of({level(0, 0, 0, 2, 1)});
    REQUIRE(alone.size() == 1);
    CHECK(alone[0].gaps.empty());
    CHECK(alone[0].length == 6);
    CHECK(leaks_of(alone).empty());
}

TEST_CASE("free borders: a surface that ends on another one has no gap there", "[borders]") {
    const auto borders = borders_of({level(0, -4, -4, 4, 4, "horizon"),
                                     quad({0, -2, 0}, {0, 2, 0}, {0, 2, 3}, {0, -2, 3}, "fault")});
    const auto fault = std::find_if(borders.begin(), borders.end(),
                                    [](const FreeBorder& b) { return b.surfaces[0] == 1; });
    REQUIRE(fault != borders.end());
    CHECK_FALSE(fault->closed); // the lower edge is not a free border
    CHECK(fault->length == 10);
    REQUIRE(fault->gaps.size() == 1);
    CHECK(fault->gaps[0].least == 3);
    CHECK(fault->gaps[0].largest == 3);
}

TEST_CASE("free borders: the smallest gaps come first", "[borders]") {
    const double hair = 0x1p-30;
    const auto borders =
        borders_of({level(0, -4, -4, 4, 4, "horizon"),
                    quad({0, -2, hair}, {0, 2, hair}, {0, 2, 3}, {0, -2, 3}, "F")});
    const auto leaks = leaks_of(borders);
    REQUIRE(leaks.size() >= 2);
    CHECK(leaks[0].from == 1);
    CHECK(leaks[0].to == 0);
    CHECK(leaks[0].decade == -10);
    CHECK(leaks[0].length == 4);
    CHECK(leaks[0].largest == hair);
    for (std::size_t i = 1; i < leaks.size(); ++i) CHECK(leaks[i].decade == 0);
}

TEST_CASE("free borders: one that lies on another surface has distance 0 and comes first",
          "[borders]") {
    Mesh mesh; // two triangles with separate vertices at the same border: a seam
    mesh.surfaces = {{"a", Role::unknown}, {"b", Role::unknown}};
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{0});
    mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{1});
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    const auto leaks = leaks_of(find_free_borders(mesh, build_structure(mesh, volumes.value())));
    REQUIRE_FALSE(leaks.empty());
    CHECK(leaks[0].largest == 0);
    CHECK(leaks[0].decade == INT_MIN);
    CHECK(leaks[0].length == 1);
}

TEST_CASE("free borders: parts of one surface are near each other as two surfaces are",
          "[borders]") {
    const auto joined = [](Surface a, const Surface& b) {
        const auto first = static_cast<std::uint32_t>(a.vertices.size());
        a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
        for (const auto& [i, j, k] : b.triangles)
            a.triangles.push_back({first + i, first + j, first + k});
        return a;
    };
    const Surface left = level(0, 0, 0, 2, 4, "a"), right = level(0, 2.25, 0, 4, 4, "b");
    const auto two = borders_of({left, right});
    const auto one = borders_of({joined(left, right)});
    REQUIRE(one.size() == 2);
    REQUIRE(two.size() == 2);
    for (std::size_t b = 0; b < 2; ++b) {
        REQUIRE(one[b].gaps.size() == two[b].gaps.size());
        for (std::size_t g = 0; g < one[b].gaps.size(); ++g) {
            CHECK(one[b].gaps[g].surface == 0);
            CHECK(one[b].gaps[g].least == two[b].gaps[g].least);
            CHECK(one[b].gaps[g].length == two[b].gaps[g].length);
        }
    }
    const auto leaks = leaks_of(one);
    REQUIRE_FALSE(leaks.empty());
    CHECK(leaks[0].from == leaks[0].to);
    CHECK(leaks[0].least == 0.25);
    // Another surface between them is nearer, and parts that touch in a vertex are one.
    const auto between = borders_of({joined(left, right), level(0, 2.0625, 0, 2.125, 4, "c")});
    for (const Leak& leak : leaks_of(between))
        if (leak.from == 0 && leak.decade < -1) CHECK(leak.to == 1);
    CHECK(leaks_of(borders_of({joined(left, level(0, 2, 4, 4, 6, "b"))})).empty());
}
