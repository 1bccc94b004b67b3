// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The data round a hole that it is filled from. Private to rbf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane {

/// Vertices near a border, along the surface, and where asked for points on edges that are long
/// (long_edges.hpp). Those of the hole's border come first, in its order, then those of islands in
/// it.
struct RbfData {
    std::vector<Point3> points;      ///< distinct
    std::vector<Point3> normals;     ///< per point: unit, the surface on the loop's left
    std::vector<double> distances;   ///< per point: from the border along edges
    std::vector<Triangle> triangles; ///< the surface's between them, wound by the normals
    std::vector<std::uint32_t> next; ///< per border point: the next in its loop. So many points
                                     ///< are the borders'
    double edge = 0;                 ///< median border edge
    double radius = 0;               ///< of a disk with the hole's area
};

struct DataRange {
    double reach = 1;        ///< in radii of the hole
    unsigned rings = 4;      ///< of vertices, at least
    bool long_edges = false; ///< points on them are data, too
};

/// All vertices not farther from the border along edges than `reach` times the radius, and those of
/// the first `rings` rings; of islands the same. `loops`: those of the surface, among which islands
/// are the outer ones of other parts within the hole, seen along its mean normal, and not farther
/// from it than its radius. Cost: linear in the surface, n log n in the data. Errors: bad_option,
/// bad_index (a loop that is none), bad_number.
Result<RbfData> collect_data(const Surface& surface, const BorderLoop& loop,
                             std::span<const BorderLoop> loops, DataRange range);

} // namespace terrane
