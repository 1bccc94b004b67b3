// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares the check of the order with clipped polygons in rationals.
#include <terrane/algorithms/layers/order_check.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <catch2/catch.hpp>

#include "oracles/clipped.hpp"
#include "support/effort.hpp"

using namespace terrane;

namespace {

using oracles::Corners;

/// Builds a mesh without shared vertices, one triangle per layer.
Mesh mesh_of(const std::vector<Corners>& layers) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < layers.size(); ++i) {
        mesh.surfaces.push_back({"layer", Role::horizon});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        mesh.surfaces_of.push_back(std::array{i});
        for (const Point3& p : layers[i]) mesh.vertices.push_back(p);
    }
    return mesh;
}

/// Tells whether the second triangle is above the first one somewhere.
bool is_wrong(const Corners& first, const Corners& second) {
    const auto s = oracles::upward(first), t = oracles::upward(second);
    if (!s || !t) return false;
    const auto polygon = oracles::common(*s, *t);
    return oracles::area(polygon) > 0 &&
           std::any_of(polygon.begin(), polygon.end(), [&](const oracles::Exact2& p) {
               return oracles::height(*t, p) > oracles::height(*s, p);
           });
}

} // namespace

TEST_CASE("layer order: finds what is out of order, and nothing else", "[layers]") {
    std::mt19937_64 random(31);
    int wrong = 0, right = 0;
    for (int i = 0; i < test_support::cases(4000); ++i) {
        std::uniform_int_distribution<int> place(0, 2 + i % 4), level(0, i % 3 == 0 ? 2 : 9);
        const auto corner = [&](int shift) {
            return Point3{static_cast<double>(place(random)), static_cast<double>(place(random)),
                          static_cast<double>(level(random) + shift)};
        };
        std::vector<Corners> layers;
        for (int k = 3; k-- > 0;) layers.push_back({corner(3 * k), corner(3 * k), corner(3 * k)});
        const auto found = find_out_of_order(mesh_of(layers), 0);
        REQUIRE(found);
        std::vector<std::array<std::uint32_t, 2>> expected, listed;
        for (std::uint32_t a = 0; a < 3; ++a)
            for (std::uint32_t b = a + 1; b < 3; ++b)
                if (is_wrong(layers[a], layers[b])) expected.push_back({a, b});
        for (const OutOfOrder& o : *found) {
            CHECK(o.depth > 0);
            CHECK(o.triangles == std::array{o.upper, o.lower});
            listed.push_back({o.upper, o.lower});
        }
        REQUIRE(listed == expected);
        ++(expected.empty() ? right : wrong);
    }
    CHECK(std::min(wrong, right) > test_support::cases(100));
}

TEST_CASE("layer order: strips along the borders are left out, as wide as allowed", "[layers]") {
    // The lower layer ends at x = 1 + 1e-9, above the upper one, which begins at x = 1.
    const Corners upper{Point3{1, 0, 0}, Point3{3, 0, 0}, Point3{1, 3, 0}},
        lower{Point3{-2, 0, 5}, Point3{1 + 1e-9, 0, 5}, Point3{1 + 1e-9, 3, 5}};
    const Mesh mesh = mesh_of({upper, lower});
    CHECK(find_out_of_order(mesh, 2e-9)->empty());
    const auto found = find_out_of_order(mesh, 5e-10);
    REQUIRE(found->size() == 1);
    CHECK(found->at(0).depth == Approx(5));
    CHECK(found->at(0).place.x == Approx(1));
    CHECK(find_out_of_order(mesh_of({lower, upper}), 0)->empty());
}
