// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The order of the triangles round an edge, and the shells that follow from it. Private to volumes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane {

/// Sorts the sides of one edge (low, high) counterclockwise about the direction from low to high,
/// the first one staying first. Exact; triangles that share a parent cost no exact numbers.
/// Precondition: no two triangles overlap, so that no two lie in the same direction.
/// Throws std::logic_error where two do. The caller holds an UpwardRounding.
void sort_round_edge(const TriangleComplex& sheets, std::uint32_t low,
                     std::span<EdgeSides::Side> sides);

/// Joins the sides of triangles that face each other round each edge: what is joined is a shell,
/// and lies on one volume. Two triangles at an edge need no predicate; one, at a free border, joins
/// its front with its back. `sides` has two elements per triangle (see sheets.hpp). Cost: linear
/// but for edges with many triangles, O(k log k) each; one allocation.
void join_round_edges(const TriangleComplex& sheets, DisjointSets& sides);

} // namespace terrane
