// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
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

/// The coordinate that a projection drops: x projects (x, y, z) to (y, z), y to (z, x), z to
/// (x, y). A triangle whose normal has a positive coordinate `axis` is therefore counterclockwise
/// in the projection.
enum class Axis : std::uint8_t { x, y, z };

/// An implicit point: states how a point is constructed from input vertices in one step.
///
/// (1) input:        the input vertex v[0].
/// (2) line_plane:   the line through v[0], v[1] meets the plane through v[2], v[3], v[4].
/// (3) three_planes: the planes through v[0..2], v[3..5] and v[6..8] meet.
/// (4) line_line:    the line through v[0], v[1] meets the plane that contains the line v[2], v[3]
///                   and is parallel to `axis`. This is the crossing of two coplanar lines,
///                   computed in a projection in which they are not parallel.
/// Equal constructions are equal values: the vertices of each line and plane are ascending; the
/// three planes of three_planes and the two lines of line_line are in lexicographic order; the axis
/// of line_line is the first of z, x, y in whose projection the lines are not parallel. Unused
/// entries are 0.
struct Construction {
    /// The kinds (1) to (4).
    enum class Kind : std::uint8_t { input, line_plane, three_planes, line_line };

    Kind kind = Kind::input;          ///< how it is constructed
    Axis axis = Axis::x;              ///< line_line only
    std::array<std::uint32_t, 9> v{}; ///< indices of input vertices

    friend bool operator==(const Construction&, const Construction&) = default;
    friend auto operator<=>(const Construction&, const Construction&) = default;
};

} // namespace terrane
