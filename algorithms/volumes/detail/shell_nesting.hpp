// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The nesting of shells: which shells bound the same volume, by lines through the components.
//
// A component is a set of triangles connected by edges; two components share vertices at most. Each
// connected part of the complement of one component is bounded by exactly one shell of it (by
// duality: the parts of the component behind two such shells would be connected through vertices
// only). So a volume is bounded by the outer shells of the components inside it and by one shell of
// the component around it, if any.
//
// For each component a line along an axis is drawn through the inside of one of its triangles and
// shifted by (epsilon, epsilon^2), so that it meets no edge. Between consecutive hits the line
// meets no triangle, so the two sides there bound the same volume and are joined; before the first
// hit and after the last one it is outside. This joins all shells of a volume: upwards from the
// last hit of a component inside the volume, the line reaches the last hits of other components
// inside it, and finally the shell around them or the outside.
#pragma once

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane {

/// Joins the shells of the same volume; element 2 * triangles of `sides` stands for the outside.
/// The other elements come from join_round_edges. The result is exact, without randomness.
/// Cost: for each axis in use a pass over all triangles, with a search among the lines (one per
/// component) for each triangle; exact arithmetic only where filters fail. Throws std::logic_error
/// if triangles overlap.
void join_nested(const TriangleComplex& sheets, DisjointSets& sides);

} // namespace terrane
