// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps (1) to (4) of joining: cuts out the part of a filling that lies inside a hole.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::joining::detail {

/// A border loop as points, with a unit normal at each. Seen from where the normals point, the
/// surface lies on the left of the loop.
struct BorderLine {
    std::vector<Point3> points;
    std::vector<Point3> normals;         ///< per point
    std::vector<std::uint32_t> vertices; ///< per point: vertex of the surface
};

/// Builds S_bound. Wall i stands on the edge from point i to the next and consists of triangles 2 i
/// and 2 i + 1. Point i has the lower vertex 2 i and the upper vertex 2 i + 1, each `half_width`
/// away.
Surface strip_along(const BorderLine& border, double half_width);

/// The filling inside of the curve: a disk, or a disk with one hole per island.
struct InnerPart {
    std::vector<Point3> points;         ///< of the filling, then of the curve, rounded to the
                                        ///< nearest doubles
    std::vector<std::uint32_t> filling; ///< per point of the filling: its vertex there, ascending
    std::vector<Triangle> triangles;    ///< indices into points; a new triangle at a border edge
                                        ///< has the orientation opposite to the loop
    std::vector<std::uint32_t> borders; ///< the borders at which it ends: that of the hole, 0, and
                                        ///< those of islands, ascending
    std::vector<std::uint32_t> corners; ///< per border point of these borders, one border after the
                                        ///< other: the point of the curve on its normal
    std::vector<std::uint32_t> between; ///< the other points of the curve, in order
};

/// Cuts out the inner part. `borders` are that of the hole, then those of possible islands; those
/// that the filling passes through inside of the hole are islands. Errors: not_closed,
/// improper_contact, and those of arrange.
Result<InnerPart> cut_inner_part(std::span<const BorderLine> borders, const Surface& filling,
                                 double half_width, Search search, const Run& run);

} // namespace terrane::joining::detail
