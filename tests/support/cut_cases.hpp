// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces cut by a volume of interest.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <gmpxx.h>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/arrangement/intersection_edges.hpp>
#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/kernel/fraction.hpp>

namespace cut_cases {

using namespace terrane;

using Spot = std::array<mpq_class, 3>;

inline std::vector<Spot> spots_of(const Arrangement& a) {
    std::vector<Spot> spots;
    for (const PointIndex v : a.vertices) {
        const auto text = fractions(a.state->points, v, 10);
        spots.push_back({mpq_class(text[0]), mpq_class(text[1]), mpq_class(text[2])});
    }
    return spots;
}

/// Computes twice the areas of a triangle's projections in rationals.
inline Spot normal_of(const Spot& a, const Spot& b, const Spot& c) {
    Spot n;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned u = (k + 1) % 3, v = (k + 2) % 3;
        n[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    }
    return n;
}

/// An arrangement of surfaces and a boundary, and the result of the cut.
struct Case {
    std::vector<Surface> surfaces; ///< those of the boundary come last
    std::vector<std::uint32_t> boundary;
    Arrangement whole;
    VolumeOfInterest cut;
    std::vector<Where> where; ///< per triangle of the whole arrangement
};

inline Case cut(std::vector<Surface> surfaces, const std::vector<Surface>& boundary) {
    Case c;
    for (const Surface& s : boundary) {
        c.boundary.push_back(static_cast<std::uint32_t>(surfaces.size()));
        surfaces.push_back(s);
    }
    c.surfaces = std::move(surfaces);
    auto whole = arrange(c.surfaces);
    REQUIRE(whole);
    c.whole = whole.value();
    auto where = locate(c.whole, c.boundary);
    INFO((where ? std::string() : where.error().message()));
    REQUIRE(where);
    c.where = std::move(where).value();
    auto made = cut_to_volume(std::move(whole).value(), c.boundary);
    REQUIRE(made);
    c.cut = std::move(made).value();
    return c;
}

/// Checks that the arrangement is the one that arrange() would find for these triangles alone.
inline void check_consistent(const Arrangement& a) {
    REQUIRE(a.parents_of.size() == a.triangles.size());
    REQUIRE(a.surfaces_of.size() == a.triangles.size());
    REQUIRE(a.state->patches.of.size() == a.triangles.size());
    std::vector<bool> used(a.vertices.size(), false);
    for (const Triangle& t : a.triangles)
        for (const std::uint32_t v : t) used.at(v) = true;
    CHECK(std::find(used.begin(), used.end(), false) == used.end());
    CHECK(a.surfaces_of == surfaces_of_parents(a.inputs, a.parents_of));
    const Adjacency by_surface = adjacency_of(group_edges(a.triangles, a.vertices.size()),
                                              labels_of(a.surfaces_of, a.parents_of));
    CHECK(a.intersection_edges == find_intersection_edges(by_surface, a.inputs, a.parents_of));
    std::size_t inner = 0;
    for (const auto& list : a.state->adjacency.inner) inner += list.size();
    std::size_t sides = 2 * inner;
    bool have_ends = true;
    for (std::size_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        sides += a.state->adjacency.triangles_at[e].size();
        for (const std::uint32_t t : a.state->adjacency.triangles_at[e])
            for (const std::uint32_t end : a.state->adjacency.edges[e])
                have_ends = have_ends && std::ranges::count(a.triangles.at(t), end) == 1;
    }
    CHECK(have_ends);
    CHECK(sides == 3 * a.triangles.size());
}

} // namespace cut_cases
