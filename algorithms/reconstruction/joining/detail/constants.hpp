// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of joining a filling to a surface.
#pragma once

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
};

inline constexpr JoinConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"most_sides", static_cast<double>(constants.most_sides)},
        {"least_swap_gain", constants.least_swap_gain},
        {"most_swap_passes", static_cast<double>(constants.most_swap_passes)},
    };
}

} // namespace terrane::joining::detail
