// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The data round a hole that it is filled from. Private to rbf.
#pragma once

#include <cstddef>
#include <vector>

#include <terrane/algorithms/holes.hpp>
#include <terrane/algorithms/mesh.hpp>
#include <terrane/algorithms/result.hpp>
#include <terrane/algorithms/surface.hpp>

namespace terrane {

/// Vertices near a border, along the surface. Those of the border come first, in its order.
struct HoleData {
    std::vector<Point3> points;      ///< distinct
    std::vector<Point3> normals;     ///< per point: unit, the surface on the loop's left
    std::vector<double> distances;   ///< per point: from the border along edges
    std::vector<Triangle> triangles; ///< the surface's between them, wound by the normals
    std::size_t border = 0;          ///< how many points are the border's
    double edge = 0;                 ///< median border edge
    double radius = 0;               ///< of a disk with the hole's area
};

/// All vertices not farther from the border along edges than `reach` times the radius, and those of
/// the first `rings` rings. Cost: linear in the surface, n log n in the data.
/// Errors: bad_option, bad_index (a loop that is none), bad_number.
Result<HoleData> data_round(const Surface& surface, const BorderLoop& loop, double reach,
                            unsigned rings);

} // namespace terrane
