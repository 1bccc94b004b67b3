// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Steps (1) to (4) of joining: the part of a filling that lies inside a hole. Private to join.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

/// A border loop as points, with a unit normal at each: the surface lies on the left of the loop
/// as seen from where the normals point.
struct BorderLine {
    std::vector<Point3> points;
    std::vector<Point3> normals;         ///< per point
    std::vector<std::uint32_t> vertices; ///< per point: of the surface
};

/// S_bound: wall i stands on the edge from point i to the next, triangles 2 i and 2 i + 1; point i
/// has the lower vertex 2 i and the upper vertex 2 i + 1, `half_width` from it.
Surface strip_along(const BorderLine& border, double half_width);

/// The filling within the curve: a disk, or one with a hole for each island.
struct InnerPart {
    std::vector<Point3> points;         ///< of the filling, then those of the curve, to the
                                        ///< nearest doubles
    std::vector<std::uint32_t> filling; ///< per point of the filling: its vertex there, ascending
    std::vector<Triangle> triangles;    ///< indices into points; a new triangle at a border edge
                                        ///< is wound opposite to the loop
    std::vector<std::uint32_t> borders; ///< which of the borders it ends at: the hole's, 0, and
                                        ///< those of islands, ascending
    std::vector<std::uint32_t> corners; ///< per border point of these borders, one after the
                                        ///< other: the curve's point on its normal
    std::vector<std::uint32_t> between; ///< the other points of the curve, in order
};

/// borders: of the hole, and of what may be islands in it: those that the filling passes through
/// inside the hole are. Errors: not_closed, improper_contact, and those of arrange.
Result<InnerPart> cut_inner_part(std::span<const BorderLine> borders, const Surface& filling,
                                 double half_width, Search search, const Run& run);

} // namespace terrane
