// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lists the parts of divided triangles that may meet improperly after their vertices moved a
// little. Most provably do not: docs/explanation/separation.md states and proves the conditions.
// (1) Faces whose intervals on the common line of their planes are apart do not meet.
// (2) Faces that cross meet properly if the parts at their common vertices are well conditioned.
// (3) A part beyond a functional that bounds the other face does not meet that face.
// (4) A part that leaves the other face at common vertices, steeply enough, meets it properly.
// (5) Two parts of one face meet properly if one of them has well conditioned vertices only.
// A vertex is well conditioned if a^2 >= 64 d l, where a is the least altitude and l the longest
// edge of the parts at it, and d is the largest move. All numbers are doubles; their rounding
// errors are added to d.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/detail/moved_parts.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// Finds the parts for which no condition proves that they meet properly. `meeting`: the pairs of
/// faces of which one is divided; sorted. Cost: linear in the parts of the mesh, in the common
/// vertices of pairs and, for pairs that are not clear as a whole, in the parts of one face that are
/// near the plane of the other; at most some hundred steps per part of a face.
Unproven find_unproven(const MovedParts& moved, std::span<const CandidatePair> meeting,
                       const Run& run);

/// Finds the parts that lie in a pool and have an ill conditioned vertex there. If two parts of one
/// face of a pool may meet improperly after the move, both have one. This follows from condition
/// (5): the sizes at a vertex are those of all parts of the pool, and the parts of the face are
/// among these. `pools` has the parts of each pool. find_unproven() does not measure a face that is
/// in no pair, and pairs within a pool are not listed. Cost: linear in the parts.
std::vector<bool> ill_conditioned_in_pools(const MovedParts& moved,
                                           const IndexLists<std::uint32_t>& pools);

} // namespace terrane::rounding::detail
