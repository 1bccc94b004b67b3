// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Triangulations of points and of polygons seen along z, by exact predicates. Heights are carried
// along and never looked at.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The Delaunay triangles of the points, front up, but those so flat that the circle round them is
/// some 1000 times as wide as all the points: these can only be at the convex hull. Of points with
/// the same x and y the first one is used. Unique: ties are broken by the order of the points in
/// the plane.
/// Cost: O(n^(4/3)) expected.
/// Errors: bad_number where coordinates are not finite, or beyond 1e300 in size; interrupted.
Result<std::vector<Triangle>> delaunay(std::span<const Point3> points, const Run& run = {});

/// A closed polygon by its corners, indices into points; either way round.
using Polygon = std::vector<std::uint32_t>;

/// The inside of polygons, points that an odd number of them goes round: the constrained Delaunay
/// triangles, front up. Each edge of a polygon is an edge of the result; each point strictly inside
/// is a vertex of it, others are left out.
/// Cost: O(n^(4/3)) expected, and n log n + the pairs of edges whose boxes overlap.
/// Errors: improper_contact where polygons touch or cross each other or themselves, or two points
/// have the same x and y, with the place; bad_number, bad_index, interrupted.
Result<std::vector<Triangle>> triangulate_inside(std::span<const Point3> points,
                                                 std::span<const Polygon> polygons,
                                                 const Run& run = {});

} // namespace terrane
