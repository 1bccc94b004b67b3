// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of joining a filling to a surface.
#pragma once

#include <array>
#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::joining::detail {

/// They decide the triangles at the border of a filling; the exact check of the result does not
/// depend on them.
struct JoinConstants : Constants {
    /// Sides of a polygon that is triangulated optimally; the effort is cubic. Vertices
    /// with larger stars are not removed.
    std::size_t most_sides = add("most_sides", 96);
    /// Gain in the worst shape for which an edge is swapped; prevents endless swaps of
    /// equal shapes.
    double least_swap_gain = add("least_swap_gain", 1e-3);
    /// Passes of swapping; few suffice, as the worst shape only improves.
    unsigned most_swap_passes = add("most_swap_passes", 20);
    /// Half widths of strips that are tried one after the other, in halves of the median border
    /// edge: a strip must reach the filling, and nothing else.
    std::array<double, 5> strips = add<double>(
        {"strips_1", "strips_2", "strips_3", "strips_4", "strips_5"}, {1, 0.125, 2, 1.4, 4});
};

inline constexpr JoinConstants constants{};

} // namespace terrane::joining::detail
