// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Repairs each place of a mesh where triangles meet improperly by itself.
#pragma once

#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/detail/repair.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::rounding::detail {

/// Repairs the places of these pairs, on coarser and coarser grids. Pairs whose triangles have corners in common are one
/// place. A place that ends conforming stays so; any other is as it was before, and is repaired again with what came to lie
/// next to it, until no place is mended any more. Returns the pairs that are left. Which places are mended does not
/// depend on the threads.
std::vector<CandidatePair> repair_places(RoundingState& state, const RepairTask& task,
                                         std::vector<CandidatePair> pairs, const Run& run);

} // namespace terrane::rounding::detail
