// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/diffusion.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "support/certified_inputs.hpp"
#include "support/points.hpp"
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Returns a grid of n x n quadrilaterals; vertex (i, j) is i * (n + 1) + j.
IndexLists<std::uint32_t> quads_of(std::uint32_t n) {
    IndexLists<std::uint32_t> quads;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
            quads.push_back(std::array{a, b, b + 1, a + 1});
        }
    return quads;
}

std::vector<Edge> sorted(std::vector<Edge> edges) {
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

TEST_CASE("diffusion: quadrilaterals are parted by a curve through the grid", "[regions]") {
    constexpr std::uint32_t n = 6;
    std::vector<Edge> curve;
    for (std::uint32_t j = 0; j < n; ++j) // the line i = 2
        curve.push_back({2 * (n + 1) + j, 2 * (n + 1) + j + 1});
    auto regions = regions_of_polygons(quads_of(n), sorted(curve));
    REQUIRE(regions.size() == n * n);
    for (std::uint32_t q = 0; q < regions.size(); ++q) CHECK(regions[q] == (q < 2 * n ? 0U : 1U));
    curve.pop_back(); // a gap is a way through
    regions = regions_of_polygons(quads_of(n), sorted(curve));
    CHECK(std::count(regions.begin(), regions.end(), 0U) == n * n);
}

TEST_CASE("diffusion: a closed curve cuts a region out", "[regions]") {
    constexpr std::uint32_t n = 5;
    const auto v = [](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
    const std::vector<Edge> ring =
        sorted({{v(2, 2), v(3, 2)}, {v(2, 3), v(3, 3)}, {v(2, 2), v(2, 3)}, {v(3, 2), v(3, 3)}});
    const auto regions = regions_of_polygons(quads_of(n), ring);
    for (std::uint32_t q = 0; q < regions.size(); ++q)
        CHECK(regions[q] == (q == 2 * n + 2 ? 1U : 0U));
}

TEST_CASE("diffusion: polygons of any number of corners; more than two at an edge stop it",
          "[regions]") {
    IndexLists<std::uint32_t> mixed;
    mixed.push_back(std::array<std::uint32_t, 3>{0, 1, 2});
    mixed.push_back(std::array<std::uint32_t, 5>{2, 1, 3, 4, 5});
    mixed.push_back(std::array<std::uint32_t, 4>{3, 4, 6, 7}); // three at 3 4 with the next
    mixed.push_back(std::array<std::uint32_t, 3>{4, 3, 8});
    mixed.push_back(std::array<std::uint32_t, 3>{6, 7, 9});
    CHECK(regions_of_polygons(mixed, {}) == std::vector<std::uint32_t>{0, 0, 1, 2, 1});
    CHECK(regions_of_polygons({}, {}).empty());
}

TEST_CASE("diffusion: random stops, against paths found by brute force", "[regions]") {
    Random random(9);
    constexpr std::uint32_t n = 8;
    for (int round = 0; round < 30; ++round) {
        const auto quads = quads_of(n);
        std::set<Edge> stops;
        for (std::uint32_t q = 0; q < quads.size(); ++q)
            for (std::size_t i = 0; i < 4; ++i)
                if (random_int(random, 0, 2) == 0)
                    stops.insert({std::min(quads[q][i], quads[q][(i + 1) % 4]),
                                  std::max(quads[q][i], quads[q][(i + 1) % 4])});
        const auto open = [&](std::uint32_t a, std::uint32_t b) {
            std::set<std::uint32_t> corners(quads[a].begin(), quads[a].end());
            std::vector<std::uint32_t> common;
            for (const std::uint32_t v : quads[b])
                if (corners.contains(v)) common.push_back(v);
            return common.size() == 2 && !stops.contains(Edge{std::min(common[0], common[1]),
                                                              std::max(common[0], common[1])});
        };
        std::vector<std::uint32_t> expected(quads.size());
        for (std::uint32_t q = 0; q < quads.size(); ++q) expected[q] = q;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::uint32_t a = 0; a < quads.size(); ++a)
                for (std::uint32_t b = 0; b < quads.size(); ++b)
                    if (expected[b] > expected[a] && open(a, b)) {
                        expected[b] = expected[a];
                        changed = true;
                    }
        }
        const std::vector<Edge> list(stops.begin(), stops.end());
        const auto regions = regions_of_polygons(quads, list);
        std::map<std::uint32_t, std::uint32_t> number; // by lowest cell
        for (const std::uint32_t lowest : expected)
            number.try_emplace(lowest, static_cast<std::uint32_t>(number.size()));
        for (std::uint32_t q = 0; q < quads.size(); ++q)
            CHECK(regions[q] == number.at(expected[q]));
    }
}

TEST_CASE("diffusion: of triangles it finds the regions of find_regions", "[regions]") {
    std::size_t compared = 0;
    for (const Model& model : certified_inputs(200)) {
        INFO(model.name);
        // Alone, each surface has the regions that its own stops leave.
        for (const Surface& surface : model.surfaces) {
            const auto a = arrange(std::vector{surface});
            REQUIRE(a);
            IndexLists<std::uint32_t> triangles;
            for (const Triangle& t : a.value().triangles) triangles.push_back(t);
            std::vector<Point3> places;
            for (const PointIndex p : a.value().vertices)
                places.push_back(a.value().state->points.nearest(p));
            const auto expected =
                find_regions(places, a.value().triangles, a.value().surfaces_of,
                             a.value().state->adjacency, a.value().intersection_edges);
            CHECK(regions_of_polygons(triangles, a.value().intersection_edges) ==
                  expected.regions_of.values);
            compared += triangles.size();
        }
    }
    CHECK(compared > 1000);
}
