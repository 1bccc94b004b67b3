// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The radial order of the triangles around an edge, and the shells that follow from it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane::volumes::detail {

/// Sorts the sides of one edge (low, high) counterclockwise around the direction from low to high;
/// the first one stays first. The order is exact; triangles that share a parent need no exact
/// arithmetic. Precondition: no two triangles overlap, so that no two have the same direction; if
/// two do, std::logic_error is thrown.
void sort_round_edge(UpwardWitness upward, const TriangleComplex& sheets, std::uint32_t low,
                     std::span<EdgeSides::Side> sides);

/// Joins the sides of triangles that face each other around each edge. Joined sides form a shell,
/// which bounds one volume. An edge with two triangles needs no predicate; a single triangle, at a
/// free border, has its front joined with its back. `sides` has two elements per triangle (see
/// complex.hpp). Cost: linear, plus O(k log k) for each edge with k > 2 triangles; one allocation.
void join_round_edges(const TriangleComplex& sheets, DisjointSets& sides);

} // namespace terrane::volumes::detail
