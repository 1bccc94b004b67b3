// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lists the gaps that sealing leaves open, and why.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/sealing/detail/facing_borders.hpp>
#include <terrane/algorithms/sealing/detail/gap_distances.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

namespace terrane::sealing::detail {

/// Returns the border edges of a sealed arrangement that are near to another surface, or face
/// another part of their own, by from, to and reason. `borders` has its free border edges.
std::vector<OpenGap> list_open_gaps(const FacingBorders& borders, const GapDistances& distances);

/// Measures the gap between an edge and another part of its own surface, if the point of that which
/// is nearest to the middle of the edge is not on the border.
std::optional<Gap> gap_to_own(const FacingBorders& borders, const GapDistances& distances,
                              std::uint32_t edge);

} // namespace terrane::sealing::detail
