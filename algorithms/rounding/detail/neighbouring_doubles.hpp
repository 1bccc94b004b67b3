// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Separates few triangles that meet improperly by moving few of their vertices to doubles next to
// theirs.
#pragma once

#include <span>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// Moves constructed vertices of the triangles of `pairs`, one after the other, to the nearest
/// place within `search_steps` doubles along each axis (tuning.hpp) with which the triangles round
/// the vertex meet fewer others improperly, by exact predicates. The deviation of the state stays
/// below `limit`, coordinates on a plane in `kept` stay, and none passes one. Vertices of the input
/// stay, too.
/// Returns whether any vertex moved. Triangles farther away than some doubles are not looked at: the
/// caller tests all pairs with a dirty corner.
/// Cost: a pass over the triangles, and some thousand exact tests per vertex.
bool search_neighbouring_doubles(RoundingState& state, std::span<const CandidatePair> pairs,
                                 const KeptPlanes& kept, double limit, const Run& run);

} // namespace terrane::rounding::detail
