// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/core/fields.hpp>

namespace terrane::tolerance::detail {

/// Constants that decide the result.
struct Tuning {
    /// Edges whose triangles meet at a larger angle than this cosine's, 26 degrees, are creases. Where
    /// three units meet along a curve, at least one of them bends by 60 degrees there.
    double crease_cosine = 0.9;
    /// The width of a fence, in distances of the farthest near surface.
    double fence_reach = 2;
    /// The least width of a fence, in spacings of doubles: below it, directions are noise.
    double fence_spacings = 64;
    /// Interfaces whose areas differ by less than this share of their cell's are alike: that of the
    /// last surface vanishes, so that of two units the first keeps its triangles.
    double alike = 0.1;
    /// An interface vanishes if that reduces the area of all triangles by this share of its cell's.
    double least_gain = 1e-9;
    /// The least number of steps per tolerance of the grid to which near vertices move; ends of edges
    /// shorter than that are joined.
    double grid_steps = 64;
    /// The least width, in spacings of doubles, of triangles that their centres tell apart.
    double located_spacings = 4096;
    /// The largest number of passes: a pass joins the thin blocks and short edges that rounding made
    /// in the last.
    unsigned most_passes = 4;
    /// The share of the tolerance by which vertices of curves may move.
    double curve_share = 0.5;
};
inline constexpr Tuning tuning;

} // namespace terrane::tolerance::detail
