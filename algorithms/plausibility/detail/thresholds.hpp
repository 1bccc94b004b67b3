// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Thresholds of the checks; docs/explanation/plausibility.md gives the reason for each.
#pragma once

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::plausibility::detail {

struct Thresholds : Constants {
    /// A surface is far away if its gap to the others exceeds this many diagonals of the larger
    /// box.
    double far_apart = add("far_apart", 1);
    /// Heights above and below 0 are two groups if the gap between them exceeds this many of their
    /// sizes.
    double height_gap = add("height_gap", 1);
    /// Turned over, a group of heights must come as near to the other, in shares of its distance
    /// from 0.
    double turned_gap = add("turned_gap", 1);
    /// Spacing of 24 bits at the largest coordinate, in shares of the mean edge, that is worth a
    /// warning.
    double float32_spacing = add("float32_spacing", 1e-4);
    /// A surface is a layer, not a wall, if its footprint is at least such a share of its area.
    double layer_footprint = add("layer_footprint", 0.5);
    /// The largest layer spans the model if its footprint is such a share of the model's.
    double spanning_footprint = add("spanning_footprint", 0.3);
    /// There may be two layers if all footprints together are this many times the largest.
    double two_layers = add("two_layers", 1.5);
    /// Degrees of longitude and latitude that a model spans at most.
    double most_degrees = add("most_degrees", 40);
    /// Horizontal coordinates beyond this are lengths, not degrees.
    double least_length = add("least_length", 1000);
};

inline constexpr Thresholds thresholds{};

} // namespace terrane::plausibility::detail
