// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The input of the search for volumes: triangles that meet only in shared vertices and edges, with
// exact points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::volumes {

/// A view of such a complex; the objects that it refers to must outlive it.
struct TriangleComplex {
    const PointStore& points;
    std::span<const PointIndex> vertices; ///< per vertex: its point; pairwise distinct
    std::span<const Triangle> triangles;  ///< indices into vertices; with area, unique
    const EdgeSides& edges;               ///< edges of the triangles
    std::span<const Triangle> planes;     ///< per triangle: three input points that span its plane,
                                          ///< wound like the triangle
    const IndexLists<std::uint32_t>*
        parents; ///< per triangle, sorted: triangles with a common parent
                 ///< are coplanar; nullptr if parents are unknown
};

/// Triangle t has two sides, numbered 2 t (front) and 2 t + 1 (back). The front is the side from
/// which its corners are counterclockwise: where orient3d is Positive.
constexpr std::uint32_t front_of(std::uint32_t triangle) {
    return 2 * triangle;
}
constexpr std::uint32_t back_of(std::uint32_t triangle) {
    return 2 * triangle + 1;
}
constexpr std::uint32_t opposite(std::uint32_t side) {
    return side ^ 1U;
}

/// Returns the side of the plane of a triangle on which a vertex lies: Positive in front.
inline Sign side_of(UpwardWitness upward, const TriangleComplex& sheets, TriangleId triangle,
                    VertexId vertex) {
    const Triangle& p = sheets.planes[triangle];
    return sheets.points.side_of_plane(upward, p[0], p[1], p[2], sheets.vertices[vertex]);
}

} // namespace terrane::volumes
