// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Decides exactly which of two triangles is above the other, seen along z.
#pragma once

#include <array>
#include <optional>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::layers::detail {

/// Corners in a store, counterclockwise in the projection along z.
using UpwardTriangle = std::array<PointIndex, 3>;

/// Orders the corners. Returns nothing for a vertical triangle, whose projection has no area.
std::optional<UpwardTriangle> seen_along_z(UpwardWitness upward, const PointStore& points,
                                           UpwardTriangle corners);

/// Tells whether the projections of the two have a common area.
bool overlap_along_z(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
                     const UpwardTriangle& t);

/// Returns the side of t on which s lies: Positive above. The triangles must overlap along z and
/// meet in common corners and edges at most, so the side is the same wherever both are. Zero if
/// they have the same heights everywhere, which means that they are the same triangle.
Sign above_along_z(UpwardWitness upward, const PointStore& points, const UpwardTriangle& s,
                   const UpwardTriangle& t);

} // namespace terrane::layers::detail
