// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of boundaries and of the extension to one; those of its strips are StripConstants.
#pragma once

#include <cstddef>

namespace terrane::volume_of_interest::detail {

/// They decide the direction of strips at rough borders.
struct ExtensionConstants {
    /// Length of border along which directions are averaged, in limits. Larger: smoother strips
    /// that follow bends of the border less.
    double window = 0.5;
    /// Largest such length, as a share of the length of the border.
    double border_share = 0.125;
    /// How often the length is doubled where a strip would fold.
    unsigned most_doublings = 3;
};
inline constexpr ExtensionConstants extension_tuning;

/// They decide what the surfaces of a boundary are.
struct BoundaryConstants {
    /// Sides of a boundary up to which each is a surface of its own; more are one surface together.
    std::size_t most_named_sides = 12;
};
inline constexpr BoundaryConstants boundary_tuning;

} // namespace terrane::volume_of_interest::detail
