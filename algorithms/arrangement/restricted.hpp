// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>

namespace terrane {

/// The arrangement without some of its triangles: with `keep` (per triangle) false.
///
/// (1) What is kept stays as it is: its points, corners, parents and patches, and the order of
///     triangles and vertices. Vertices without a triangle go.
/// (2) Adjacency, intersection edges and neighbours are those of the kept triangles alone. So
///     rounding, volumes, structure and tetrahedra work on it as on any other.
/// (3) Surfaces and the numbers of input triangles stay, also of those with nothing left.
/// (4) Rounding may move input vertices, which is its last resort, only if restrict_again of the
///     state is set (exact_arrangement.hpp). This function leaves it unchanged.
/// (5) Input triangles are no longer the union of those that name them: `whole` of the state becomes
///     false, and there is no certificate for it.
/// Cost: linear.
Arrangement restricted(Arrangement arrangement, const std::vector<bool>& keep, const Run& run = {});

} // namespace terrane
