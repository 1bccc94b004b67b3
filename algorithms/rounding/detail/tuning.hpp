// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants that decide how rounding repairs contacts. They change which conforming mesh comes
// out, never whether it is checked.
#pragma once

#include <array>
#include <cstddef>

namespace terrane::rounding::detail {

/// Grids are named by the number of binary digits that they drop: their spacing is 2^digits units
/// in the last place of the largest coordinate on each axis.
///
/// What crosses is first snapped where it lies, with fine grids, so that as little as possible
/// moves. That is enough for single mishaps. Sheets that are nearly coplanar over an area multiply
/// under it (touching_ridges_turned). So where a round does not shrink the contacts to a quarter,
/// the input triangles concerned are snapped instead, and the input is arranged anew; at once where
/// contacts are crowded from the start (coplanar_half_turned), since fine rounds only multiply them.
struct RoundingTuning {
    std::array<int, 3> fine_digits{4, 8, 12}; ///< grids for the output, one after the other
    std::array<int, 5> coarse_digits{16, 20, 24, 28, 32}; ///< grids for the input
    std::size_t many = 1024;                              ///< contacts: fewer are never crowded
    std::size_t crowded = 8;    ///< triangles per contact: fewer are crowded
    std::size_t multiplied = 8; ///< growth of contacts in a round that counts as a failure
    unsigned widenings = 3;     ///< times that more input triangles are snapped to one grid
    unsigned shrinking = 4;     ///< a round helps if it divides the contacts by at least this
};

inline constexpr RoundingTuning rounding_tuning;

} // namespace terrane::rounding::detail
