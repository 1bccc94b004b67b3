// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of sealing that decide the size of strips.
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/core/named_constant.hpp>

namespace terrane::sealing::detail {

/// Strips are cut exactly where they meet other surfaces, so their size decides only which surfaces
/// they reach.
struct SealConstants {
    /// Width of strips along the tangent plane, in gaps: enough where surfaces meet at 15
    /// degrees or more.
    double width_per_gap = 4;
    /// Rounds that remove useless strips; more than one is needed only where strips depend
    /// on each other.
    unsigned most_rounds = 4;
    /// Least width, in units in the last place of the coordinates: narrower strips have no
    /// meaningful direction.
    double least_width = 1024;
    /// Samples per edge of a triangle whose distance from a curve is judged.
    std::size_t overshoot_samples = 8;
    /// Distance up to which the ends of a gap look for the surface that the gap is measured to,
    /// in distances of sealing.
    double end_reach = 2;
};

inline constexpr SealConstants constants;

/// Lists all constants by name, in the order of their declaration.
inline std::vector<NamedConstant> named_constants() {
    return {
        {"width_per_gap", constants.width_per_gap},
        {"most_rounds", static_cast<double>(constants.most_rounds)},
        {"least_width", constants.least_width},
        {"overshoot_samples", static_cast<double>(constants.overshoot_samples)},
        {"end_reach", constants.end_reach},
    };
}

} // namespace terrane::sealing::detail
