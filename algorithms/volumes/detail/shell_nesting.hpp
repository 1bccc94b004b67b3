// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The nesting of shells: which shells bound the same volume, by lines through the components.
//
// A component is a set of triangles connected by edges. On each connected part of the complement of
// one component there is exactly one of its shells, so a volume is bounded by the outer shells of
// the components inside it and by one shell of the component around it, if any: statements (1) and
// (2) of docs/explanation/shell-nesting.md. For each component a line along an axis passes through
// the inside of one of its triangles, shifted by (epsilon, epsilon^2) so that it meets no edge.
// Sides between consecutive hits are joined; this joins all shells of a volume: statement (3).
#pragma once

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane::volumes::detail {

/// Joins the shells of the same volume; element 2 * triangles of `sides` stands for the outside.
/// The other elements come from join_round_edges. The result is exact, without randomness.
/// Cost: for each axis in use a pass over all triangles, with a search among the lines (one per
/// component) for each triangle; exact arithmetic only where filters fail. Throws std::logic_error
/// if triangles overlap.
void join_nested(const TriangleComplex& sheets, DisjointSets& sides);

} // namespace terrane::volumes::detail
