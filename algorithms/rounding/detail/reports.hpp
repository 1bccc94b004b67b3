// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parts of the report that compare the mesh of doubles with the arrangement.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// Returns the input triangles that have parts in the arrangement but not in `parents_of`;
/// ascending.
std::vector<std::uint32_t> vanished(const Arrangement& arrangement,
                                    const IndexLists<std::uint32_t>& parents_of);

/// Adds the moves of the snapped input to those of its rounding. Where surfaces cross at a small
/// angle, their intersection moves farther than their corners. `first` is the report of the
/// rounding without snapped input.
void add_to_report(const SnappedInput& snapped, const Arrangement& arrangement,
                   const RoundingReport& first, RoundedMesh& rounded);

/// Compares the regions with those of the exact surfaces and reports losses.
void report_lost_regions(const Arrangement& arrangement, RoundedMesh& rounded);

} // namespace terrane::rounding::detail
