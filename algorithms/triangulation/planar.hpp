// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangulates points and polygons seen along z with exact predicates. Heights have no influence on
// the result.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Returns the Delaunay triangulation of the points, counterclockwise seen along z. Hull triangles
/// whose circumcircle is wider than about 1000 times the point set are omitted, so the convex hull
/// may be incomplete. Of several points with the same x and y the first one is used. The result is
/// unique: ties are broken by the order of the points in the plane.
/// Cost: O(n^(4/3)) expected.
/// Errors: bad_number (an x or y is not finite, or beyond 1e300 in size); interrupted.
Result<std::vector<Triangle>> delaunay(std::span<const Point3> points, const Run& run = {});

/// The corners of a closed polygon, as indices into points; in either orientation.
using Polygon = std::vector<std::uint32_t>;

/// Returns the constrained Delaunay triangulation of the inside of polygons, counterclockwise seen
/// along z. A place is inside if an odd number of polygons surround it. Each edge of a polygon is
/// an edge of the result. Each point strictly inside is a vertex of it; other points are left out.
/// Cost: O(n^(4/3)) expected, plus one test per pair of polygon edges whose ranges of x overlap.
/// Errors: improper_contact with the place (polygons touch or cross each other or themselves, or
/// two points have the same x and y); bad_number as delaunay; bad_index; interrupted.
Result<std::vector<Triangle>> triangulate_inside(std::span<const Point3> points,
                                                 std::span<const Polygon> polygons,
                                                 const Run& run = {});

} // namespace terrane
