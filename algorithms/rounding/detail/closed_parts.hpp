// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds parts of one input triangle, or of two with a common side, that enclose a space, once sheets
// that nearly coincide were joined.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>

namespace terrane::rounding::detail {

/// Returns the parts of each input triangle up to the last that has any, ascending.
IndexLists<std::uint32_t> parts_of_inputs(const IndexLists<std::uint32_t>& parents_of);

/// Returns parts of one input triangle without which its parts enclose nothing, and have the same
/// edges, pieces and holes: statement (5) of docs/explanation/rounding.md. Of parts that will do it
/// returns those with fewest parents. `parts` are indices into `triangles`. Cost: near-linear where
/// nothing is enclosed, else cubic in the number of the parts that do.
std::vector<std::uint32_t> superfluous_parts(std::span<const Triangle> triangles,
                                             const IndexLists<std::uint32_t>& parents_of,
                                             std::span<const std::uint32_t> parts);

/// Returns pairs of input triangles with a common side whose parts have in common what has a hole or
/// is torn: the parts then nearly coincide. corners: of the input triangles.
/// Cost: a pass over the edges, and one over the parts of each pair that overlaps.
std::vector<Side> ill_joined(std::span<const Triangle> triangles,
                             const IndexLists<std::uint32_t>& parents_of,
                             std::span<const Triangle> corners);

/// Tells whether a change of triangles may have made two input triangles with a common side ill-joined that
/// were not: whether the Euler characteristic of what they have in common is another. before, after:
/// all triangles that have a vertex of a changed one, or more. corners: per input triangle of these.
bool may_change_joints(std::span<const Triangle> before,
                       const IndexLists<std::uint32_t>& parents_before,
                       std::span<const Triangle> after,
                       const IndexLists<std::uint32_t>& parents_after,
                       const std::map<std::uint32_t, Triangle>& corners);

} // namespace terrane::rounding::detail
