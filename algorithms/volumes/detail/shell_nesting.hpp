// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which shells lie on the same volume, by lines through the components. Private to volumes.
//
// A component is what hangs together by edges; two of them share vertices at most. Each region that
// one component leaves in space has exactly one shell of it (by duality: what two shells of a
// region had behind them could be joined only through vertices). So a volume is bounded by the
// outer shells of the components inside it and by one shell of the component around it, if any.
//
// For each component a line along an axis is drawn through the inside of one of its triangles and
// shifted by (epsilon, epsilon^2), so that it meets no edge. Between neighbouring hits it meets
// nothing: the two sides there lie on one volume and are joined; before the first and after the
// last it is outside. That joins everything: going up from the last hit of a component inside a
// volume, the line comes to the last hits of other components inside it, and at last to the shell
// around them or to the outside.
#pragma once

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/detail/complex.hpp>

namespace terrane {

/// Joins shells of the same volume, and with element 2 * triangles, the outside. `sides` comes from
/// join_round_edges and has that one element more. Exact, without randomness.
/// Cost: per axis in use a pass over all triangles, with a search among the lines (one per
/// component) for each; exact numbers only where filters can't tell. Throws std::logic_error where
/// triangles overlap.
void join_nested(const TriangleComplex& sheets, DisjointSets& sides);

} // namespace terrane
