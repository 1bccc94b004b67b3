// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace terrane {

/// The coordinate that a projection drops: x projects (x, y, z) to (y, z), y to (z, x), z to (x,
/// y). So a triangle whose normal has a positive coordinate `axis` is counterclockwise in the
/// projection.
enum class Axis : std::uint8_t { x, y, z };

/// How a point follows from input vertices, in one step (depth one): an implicit point.
///
/// (1) input:        the input vertex v[0].
/// (2) line_plane:   the line through v[0], v[1] meets the plane through v[2], v[3], v[4].
/// (3) three_planes: the planes through v[0..2], v[3..5] and v[6..8] meet.
/// (4) line_line:    the line through v[0], v[1] meets the plane through the line v[2], v[3] and
///                   parallel to `axis`: the crossing of two coplanar lines, computed in a
///                   projection in which they are not parallel.
/// The vertices of each line and plane are ascending, lines and planes of one kind are in
/// lexicographic order where they are interchangeable (three_planes; and in line_line the smaller
/// line comes first, and axis is the first of z, x, y in which the lines are not parallel): equal
/// constructions are equal values. Unused entries are 0.
struct Construction {
    /// See (1) to (4).
    enum class Kind : std::uint8_t { input, line_plane, three_planes, line_line };

    Kind kind = Kind::input;          ///< how it is constructed
    Axis axis = Axis::x;              ///< line_line only
    std::array<std::uint32_t, 9> v{}; ///< input vertices

    friend bool operator==(const Construction&, const Construction&) = default;
    friend auto operator<=>(const Construction&, const Construction&) = default;
};

} // namespace terrane
