// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A point inside each block, for programs that find regions from points (TetGen).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/region_point.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// One point for each block, in their order; a block in which no point of doubles was found has
/// none. The point is guessed (half way from the middle of a large triangle to what it faces) and
/// then tested by volume_around. `volumes` are those of the mesh, which is conforming.
/// Cost: a few passes over the triangles per block. Errors: interrupted.
Result<std::vector<RegionPoint>> region_points(const Mesh& mesh, const Volumes& volumes,
                                               const Run& run = {});

/// The volume that a point lies in, by an exact segment to the outside; none where it lies on a
/// triangle, or every segment that was tried meets an edge.
std::optional<std::uint32_t> volume_around(const Point3& place, const Mesh& mesh,
                                           const Volumes& volumes);

} // namespace terrane
