// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::tolerance::detail {

/// Moves the vertices that are nearer to another surface than `bound`, but not on it, to points of a grid
/// whose spacing is about a 64th of it: crossings of sheets that differ by rounding errors only would be
/// nearer than doubles can tell.
void snap_near_vertices(std::vector<Surface>& surfaces, double bound);

/// Returns where vertices go that are joined, as edges shorter than that spacing are between them.
std::map<Point3, Point3> near_vertices(std::span<const Point3> points,
                                       std::span<const Triangle> triangles, double bound);

/// Moves vertices to where they go.
void join_near_vertices(std::vector<Surface>& surfaces, const std::map<Point3, Point3>& joined);

/// Returns strips of triangles across the space beside borders and creases: from each edge that is near
/// another surface, on both sides of each of its triangles, perpendicular to the smooth part of the
/// surface there, as far as the near surfaces are, at most `tolerance`. So the thin space beside a
/// smooth part of a surface ends where the part ends.
Surface fences_of(const std::vector<Surface>& surfaces, double tolerance);

} // namespace terrane::tolerance::detail
