// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks in which many points lie, found exactly; and a point inside each block, for programs
// that find blocks from points (TetGen).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A point inside a volume.
struct BlockPoint {
    Point3 place;    ///< strictly inside, in the unit of the mesh
    BlockId block{}; ///< number of the block
};

/// Returns for each point, which is finite, the volume that contains it; 0 is the outside. A point on
/// a triangle counts to the volume on the side of greater x; where the triangle is parallel to x, of
/// greater y, and where it is parallel to y as well, of greater z: it is shifted by
/// (e, e^2, e^3) for an infinitely small e. `volumes` are those of the mesh, which is conforming.
/// A vertical line upward from each point is searched for the lowest triangle above it, in a tree of
/// boxes in the map; doubles decide only where their error is bounded, exact numbers elsewhere.
/// Cost: n log n for n triangles; per point log n and the number of triangles on its line. Errors:
/// interrupted; internal if triangles are found to overlap.
Result<std::vector<std::uint32_t>> locate_points(std::span<const Point3> points, const Mesh& mesh,
                                                 const Volumes& volumes, const Run& run = {});

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
