// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A point inside each block, for programs that find blocks from points (TetGen).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/block_point.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Returns one point for each block, in their order; a block in which no point with coordinates in
/// doubles was found has none. A candidate, half way from the middle of a large triangle to the
/// triangle that it faces, is verified by volume_around. `volumes` are those of the mesh, which is
/// conforming.
/// Cost: a few passes over the triangles per block. Errors: interrupted.
Result<std::vector<BlockPoint>> block_points(const Mesh& mesh, const Volumes& volumes,
                                             const Run& run = {});

/// Returns the volume that contains a point, by exact tests of a segment from it to the outside;
/// none if the point lies on a triangle, or if every segment that was tried meets an edge.
std::optional<BlockId> volume_around(const Point3& place, const Mesh& mesh, const Volumes& volumes);

} // namespace terrane
