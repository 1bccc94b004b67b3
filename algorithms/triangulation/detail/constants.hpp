// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of surfaces that are made of scattered points.
#pragma once

#include <terrane/algorithms/core/constants.hpp>

namespace terrane::triangulation::detail {

/// They decide which triangles connect the points.
struct PointConstants : Constants {
    /// Share of the median edge to which edges must shrink in space for the plane of least squares
    /// to replace z = 0. Smaller: fewer points are seen along another direction than z.
    double worth_tilting = add("worth_tilting", 0.8);
    /// Least z component of a normal that counts as upright, squared: 45 degrees.
    double upright = add("upright", 0.5);
    /// Default of the longest edge, in median edges. Larger: holes are closed.
    double longest_edge = add("longest_edge", 2);
    /// Distance of the far corners of a Delaunay triangulation, in sizes of the points. Smaller:
    /// more flat triangles at the convex hull are omitted.
    double surroundings = add("surroundings", 1024);
};

inline constexpr PointConstants constants{};

} // namespace terrane::triangulation::detail
