// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants that classify holes and refine fillings.
#pragma once

#include <cstddef>

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::holes::detail {

/// They decide whether a hole counts as a fault gap, and how often a filling is refined.
struct HoleConstants : Constants {
    /// Share of a gap along which the same side must be up. Larger: fewer holes count as
    /// fault gaps.
    double agreement = add("agreement", 0.8);
    /// Least throw of a fault gap, in roughnesses of the border: below, noise could be
    /// taken for throw.
    double roughness_factor = add("roughness_factor", 3);
    /// Steeper slopes of a border triangle are not extrapolated, as they are those of slivers.
    double steepest = add("steepest", 10);
    /// Edges of a hole from which the opposite side is searched. Larger: more time on long borders.
    std::size_t most_probes = add("most_probes", 256);
    /// Least diagonal of an outer border, in diagonals of its part; parts without such a
    /// border are closed bodies with holes.
    double outer_share = add("outer_share", 0.5);
    /// Sags below this share of the edge length count as rounding.
    double rounding = add("rounding", 1e-6);
    /// How often a default mesh size may be halved. Larger: finer fillings of sharp bends, more
    /// time.
    unsigned most_halvings = add("most_halvings", 2);
    /// Points of a filling. An edge length that asks for more is refused.
    double most_points = add("most_points", 1e6);
};

inline constexpr HoleConstants constants{};

} // namespace terrane::holes::detail
