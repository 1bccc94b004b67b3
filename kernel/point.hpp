// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>

namespace terrane {

/// A point with finite double coordinates, in the unit of the file it came from.
struct Point3 {
    double x = 0; ///< east, or as the file says
    double y = 0; ///< north, or as the file says
    double z = 0; ///< up

    friend bool operator==(const Point3&, const Point3&) = default;
    friend auto operator<=>(const Point3&, const Point3&) = default; ///< lexicographic
};

/// Index of a point of an arrangement: input vertices first, constructed points after them.
using PointIndex = std::uint32_t;

} // namespace terrane
