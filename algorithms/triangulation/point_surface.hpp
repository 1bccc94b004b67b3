// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

struct ConnectOptions {
    double max_edge = 0; ///< unit of the points; 0: twice the median length of Delaunay edges
};

/// Scattered points as a surface: Delaunay triangles in the best plane, without those that have an
/// edge longer than allowed, measured in the plane. Where points are missing there are holes.
/// The best plane is z = 0, so that horizons are triangulated by x and y as they stand; but that of
/// least squares where its normal is more than 45 degrees from z and the triangles have shorter
/// edges in space then, by a fifth of the median. (A narrow horizon has its least extent sideways.)
/// Of points at one place of the plane the first one is used; the others are in no triangle.
/// Cost: as delaunay (planar.hpp). Errors: as delaunay; bad_option.
Result<std::vector<Triangle>> connect_points(std::span<const Point3> points,
                                             const ConnectOptions& options = {},
                                             const Run& run = {});

} // namespace terrane
