// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of joining a filling to a surface.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::joining::detail {

/// They decide the triangles at the border of a filling; the exact check of the result does not
/// depend on them.
struct JoinConstants {
    /// Sides of a polygon that is triangulated optimally; the effort is cubic. Vertices
    /// with larger stars are not removed.
    std::size_t most_sides = 96;
    /// Gain in the worst shape for which an edge is swapped; prevents endless swaps of
    /// equal shapes.
    double least_swap_gain = 1e-3;
    /// Passes of swapping; few suffice, as the worst shape only improves.
    unsigned most_swap_passes = 20;
    /// Half widths of strips that are tried one after the other, in halves of the median border
    /// edge: a strip must reach the filling, and nothing else.
    std::array<double, 5> strips{1, 0.125, 2, 1.4, 4};
};

inline constexpr JoinConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"most_sides", static_cast<double>(constants.most_sides)},
        {"least_swap_gain", constants.least_swap_gain},
        {"most_swap_passes", static_cast<double>(constants.most_swap_passes)},
        {"strips_1", constants.strips[0]},
        {"strips_2", constants.strips[1]},
        {"strips_3", constants.strips[2]},
        {"strips_4", constants.strips[3]},
        {"strips_5", constants.strips[4]},
    };
}

} // namespace terrane::joining::detail
