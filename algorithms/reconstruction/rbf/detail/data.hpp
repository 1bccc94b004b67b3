// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Collects the data from which a hole is filled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

namespace terrane::rbf::detail {

/// The vertices near a border, measured along the surface, and on request points on long edges
/// (long_edges.hpp). Those of the hole's border come first, in order, then those of islands in it.
struct RbfData {
    std::vector<Point3> points;      ///< distinct
    std::vector<Point3> normals;     ///< per point: unit length; oriented so that the surface is on
                                     ///< the loop's left
    std::vector<double> distances;   ///< per point: distance from the border along edges
    std::vector<Triangle> triangles; ///< those of the surface between the points, oriented by the
                                     ///< normals
    std::vector<std::uint32_t> next; ///< per border point: the next one in its loop; its size is
                                     ///< the number of border points
    double edge = 0;                 ///< median border edge
    double radius = 0;               ///< of a disk with the hole's area
};

struct DataRange {
    double reach = 1;        ///< in radii of the hole
    unsigned rings = 4;      ///< least number of rings of vertices
    bool long_edges = false; ///< points on long edges are data, too
};

/// Collects all vertices whose distance from the border along edges is at most `reach` times the
/// radius, and those of the first `rings` rings; also around islands. Islands are those of the
/// `loops` of the surface that are outer loops of other parts, lie within the hole seen along its
/// mean normal, and are no farther from it than its radius. Cost: linear in the surface, n log n in
/// the data. Errors: bad_option, bad_index (an invalid loop), bad_number.
Result<RbfData> collect_data(const Surface& surface, const BorderLoop& loop,
                             std::span<const BorderLoop> loops, DataRange range);

} // namespace terrane::rbf::detail
