// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds which triangles of a pool contain each part of its plane, which has been triangulated once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/contacts.hpp>
#include <terrane/algorithms/triangulation/triangulation.hpp>

namespace terrane::arrangement::detail {

/// A part of a pool.
struct PoolPart {
    std::uint32_t face;                ///< the first triangle that contains it
    std::uint32_t cover;               ///< index into covers
    std::array<PointIndex, 3> corners; ///< oriented as that triangle
};

/// The parts of a pool.
struct PoolDivision {
    std::vector<PoolPart> parts;      ///< by face
    IndexLists<std::uint32_t> covers; ///< triangles that contain a part, ascending
};

/// Returns a frame round the points in the projection.
Frame frame_round(const PointStore& points, Axis axis, std::span<const PointIndex> inside);

/// Returns the parts that the triangulation of a framed face has made of the triangles of a pool,
/// all of whose edges are on its segments. Empty if the run was stopped. Cost: linear in the
/// triangulation, in the parts of the edges, and in the lengths of the covers.
PoolDivision covers_of_pool(UpwardWitness upward, const TriangleSoup& soup,
                            std::span<const std::uint32_t> faces, const PointStore& points,
                            const PointOrder& order, const FaceInput& input,
                            const FaceTriangulation& triangulation);

} // namespace terrane::arrangement::detail
