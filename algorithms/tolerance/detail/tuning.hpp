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
    /// Fences reach so many times as far as the farthest of the near surfaces.
    double fence_reach = 2;
    /// Fences are at least so many spacings of doubles wide: fewer give directions that are noise.
    double fence_spacings = 64;
    /// Interfaces whose areas differ by less than this share of their cell's are alike: that of the
    /// last surface vanishes, so that of two units the first keeps its triangles.
    double alike = 0.1;
    /// An interface vanishes if all triangles then have less area, by this share of its cell's.
    double least_gain = 1e-9;
    /// The grid of near vertices has at least so many spacings per tolerance.
    double grid_steps = 64;
    /// Triangles narrower than so many spacings are not told apart by the place of their centres.
    double located_spacings = 4096;
    /// Surfaces are joined again, so often at most, where rounding made thin blocks.
    unsigned most_passes = 4;
    /// The share of the tolerance by which vertices of curves may move.
    double curve_share = 0.5;
};
inline constexpr Tuning tuning;

} // namespace terrane::tolerance::detail
