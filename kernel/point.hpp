// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>

namespace terrane {

/// A point with double coordinates, in the unit of the file it came from. Finite.
struct Point3 {
    double x = 0; ///< east, or as the file says
    double y = 0; ///< north, or as the file says
    double z = 0; ///< up

    friend bool operator==(const Point3&, const Point3&) = default;
    friend auto operator<=>(const Point3&, const Point3&) = default; ///< lexicographic
};

} // namespace terrane
