// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Thresholds of the checks; docs/explanation/plausibility.md gives the reason for each.
#pragma once

namespace terrane::plausibility::detail {

struct Thresholds {
    /// A surface is far away if its gap to the others exceeds this, in diagonals of the larger box.
    double far_apart = 1;
    /// Heights above and below 0 are two groups if the gap between them exceeds this, in sizes of the
    /// groups.
    double height_gap = 1;
    /// Largest distance of a group of heights from the other after a change of sign, as a share of its
    /// distance from 0.
    double turned_gap = 1;
    /// Least spacing of 24 bits at the largest coordinate that is worth a warning, as a share of the
    /// mean edge.
    double float32_spacing = 1e-4;
    /// A surface is a layer, not a wall, if its footprint is at least this share of its area.
    double layer_footprint = 0.5;
    /// The largest layer spans the model if its footprint is at least this share of the model's.
    double spanning_footprint = 0.3;
    /// There may be two layers if all footprints together are at least this multiple of the largest.
    double two_layers = 1.5;
    /// Largest extent of a model in degrees of longitude and latitude.
    double most_degrees = 40;
    /// Horizontal coordinates beyond this are lengths, not degrees.
    double least_length = 1000;
};

inline constexpr Thresholds thresholds;

} // namespace terrane::plausibility::detail
