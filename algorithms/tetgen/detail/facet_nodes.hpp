// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Puts the nodes that a mesher added on triangles back on them.
#pragma once

#include <terrane/algorithms/tetgen/detail/assembly.hpp>

namespace terrane::tetgen::detail {

/// Moves each node that was added on a triangle of the domain, and is farther from it than the check
/// of tetrahedra allows, to the doubles nearest to the foot of its perpendicular: on the edge if it
/// is on one, else on the plane. Such a node is then off by half a spacing in each coordinate.
///
/// TetGen computes nodes as centres of circles through other nodes, which are rounded. Where these
/// are close together, the centre is off their triangle by many times as much as they are, and
/// centres of such circles by more again.
///
/// `output` has sound indices. A node on the border of the faces of a triangle is on the edge between
/// the two corners that the border meets before and after it. Returns false if that border is no
/// closed polygon through the corners, or if a node is farther away than rounding can put it: then
/// the mesher has failed. Cost: O(n log n).
bool put_on_triangles(const TetgenDomain& domain, TetgenOutput& output);

} // namespace terrane::tetgen::detail
