// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The radial order of the triangles around an edge, and the shells that follow from it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/volumes/complex.hpp>

namespace terrane::volumes {

/// Sorts the sides of one edge (low, high) counterclockwise around the direction from low to high;
/// the first one stays first. The order is exact; triangles that share a parent need no exact
/// arithmetic. Precondition: no two triangles overlap, so that no two have the same direction; if
/// two do, std::logic_error is thrown.
void sort_round_edge(UpwardWitness upward, const TriangleComplex& sheets, std::uint32_t low,
                     std::span<EdgeSides::Side> sides);

/// Returns the side of a triangle that faces growing angles round an edge.
inline std::uint32_t ahead(const TriangleComplex& sheets, std::uint32_t low,
                           const EdgeSides::Side& s) {
    const bool upward = runs_along(sheets.triangles[s.triangle], low, s.high);
    return upward ? front_of(s.triangle) : back_of(s.triangle);
}

/// Calls join(side, other side) for the sides of triangles that face each other around one edge,
/// whose sides are sorted.
template <class Join>
void join_round_edge(const TriangleComplex& sheets, std::uint32_t low,
                     std::span<const EdgeSides::Side> sorted, const Join& join) {
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const EdgeSides::Side& next = sorted[(i + 1) % sorted.size()];
        join(ahead(sheets, low, sorted[i]), opposite(ahead(sheets, low, next)));
    }
}

/// Joins the sides of triangles that face each other around each edge. Joined sides form a shell,
/// which bounds one volume. An edge with two triangles needs no predicate; a single triangle, at a
/// free border, has its front joined with its back. `sides` has two elements per triangle (see
/// complex.hpp). Cost: linear, plus O(k log k) for each edge with k > 2 triangles; one allocation.
void join_round_edges(const TriangleComplex& sheets, DisjointSets& sides);
/// Does the same by the adjacency of the triangles, which need not be grouped by edge for it.
void join_round_edges(const TriangleComplex& sheets, const Adjacency& adjacency,
                      DisjointSets& sides);

} // namespace terrane::volumes
