// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which of two triangles is above the other, seen along z, exactly. Private to layers.
#pragma once

#include <array>
#include <optional>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::layers::detail {

/// Corners in a store, counterclockwise in the projection along z.
using UprightTriangle = std::array<PointIndex, 3>;

/// None for a triangle that is upright: its projection has no area.
std::optional<UprightTriangle> seen_along_z(const PointStore& points, UprightTriangle corners);

/// Whether the projections of the two have an area in common.
bool overlap_along_z(const PointStore& points, const UprightTriangle& s, const UprightTriangle& t);

/// Side on which s lies of t: Positive above. The triangles overlap along z and meet in common
/// corners and edges at most, so it is the same wherever both are. Zero where they have the same
/// heights all over, which is the same triangle. The caller holds an UpwardRounding.
Sign above_along_z(const PointStore& points, const UprightTriangle& s, const UprightTriangle& t);

} // namespace terrane::layers::detail
