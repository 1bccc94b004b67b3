// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::tolerance::detail {

/// Moves the vertices that are nearer to another surface than `bound`, but not on it, to points of a grid
/// whose spacing is about a 64th of it: crossings of sheets that differ by rounding errors only would be
/// nearer than doubles can tell.
void snap_near_vertices(std::vector<Surface>& surfaces, double bound);

/// Returns strips of triangles across the space beside borders and creases: from each edge that is near
/// another surface, on both sides of each of its triangles, perpendicular to the smooth part of the
/// surface there, as far as the near surfaces are, at most `tolerance`. So the thin space beside a
/// smooth part of a surface ends where the part ends.
Surface fences_of(const std::vector<Surface>& surfaces, double tolerance);

} // namespace terrane::tolerance::detail
