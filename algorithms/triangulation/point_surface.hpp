// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Options of connect_points().
struct ConnectOptions {
    double max_edge = 0; ///< unit of the points; 0: twice the median length of Delaunay edges
};

/// Returns a surface through scattered points: the Delaunay triangles in a plane, without those
/// that have an edge longer than max_edge, measured in the plane, and without those that have no
/// area in space. It has holes where points are missing. Of several points at one place of the
/// plane the first one is used; the others belong to no triangle.
/// The plane is z = 0, so that horizons are triangulated by x and y. The plane of least squares is
/// used instead if its normal is more than 45 degrees from z and the median edge length in space
/// becomes shorter by more than a fifth. (The second condition keeps narrow horizons in z = 0,
/// whose least extent is horizontal.)
/// Cost: that of delaunay (planar.hpp). Errors: those of delaunay; bad_option (max_edge is negative
/// or NaN).
Result<std::vector<Triangle>> connect_points(std::span<const Point3> points,
                                             const ConnectOptions& options = {},
                                             const Run& run = {});

/// Returns a surface that fills a closed line in space, whose first point is not repeated: the
/// constrained Delaunay triangulation of its inside in the plane of least squares. No point is added,
/// and each segment of the line is an edge. Cost and errors: those of triangulate_inside (planar.hpp);
/// improper_contact, without a place, if the line touches or crosses itself in that plane.
Result<std::vector<Triangle>> fill_closed_line(std::span<const Point3> line, const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> point_constants();

} // namespace terrane
