// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Input triangles of which nothing is left in the mesh of doubles.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane::rounding::detail {

/// Returns the input triangles that have parts in the arrangement but not in `parents_of`;
/// ascending.
std::vector<std::uint32_t> vanished(const Arrangement& arrangement,
                                    const IndexLists<std::uint32_t>& parents_of);

/// The error where no triangle would be left.
Error nothing_left();

/// Enlarges report.vanished_length, and report.deviation with it, until each point of the sides of each
/// input triangle that vanished is shown to be at most report.deviation away from the mesh. Of an
/// arrangement of which a part was removed, these are the sides of the kept part. Exact numbers
/// decide; where they show no smaller bound, it may be two times too large.
/// Precondition: the mesh has a triangle.
/// Cost: some exact distances per side, if the triangle collapsed onto others.
void state_vanished_length(const Arrangement& arrangement, RoundedMesh& rounded, const Run& run);

} // namespace terrane::rounding::detail
