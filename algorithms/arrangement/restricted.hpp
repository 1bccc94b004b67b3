// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>

namespace terrane {

/// Removes the triangles for which `keep` (per triangle) is false from an arrangement.
///
/// (1) The kept triangles keep their points, parents and patches, and triangles and vertices keep
///     their order. Vertices without a triangle are removed.
/// (2) Adjacency, intersection edges and neighbours are those of the kept triangles alone.
///     Rounding, volumes, structure and tetrahedra therefore work as on any other arrangement.
/// (3) Surfaces and the numbers of input triangles do not change, even if none of their triangles
///     is kept.
/// (4) Rounding may move the input and arrange it again, which is its last resort, only if
///     restrict_again of the state is set (exact_arrangement.hpp). This function does not change
///     restrict_again.
/// (5) Input triangles are no longer the unions of the triangles that name them. `whole` of the
///     state becomes false, and no certificate can be written. If all triangles are kept, nothing
///     changes.
/// Cost: linear.
Arrangement restricted(Arrangement arrangement, const std::vector<bool>& keep);

} // namespace terrane
