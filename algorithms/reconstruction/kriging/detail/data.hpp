// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Collects the data around a hole of a surface z = f(x, y), and the places of new points in it.
#pragma once

#include <span>
#include <stop_token>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/triangulation/planar.hpp>

namespace terrane::kriging::detail {

/// Points of the surface near a hole.
struct KrigingData {
    std::vector<Point3> points;          ///< distinct; border points first, in the
                                         ///< order of the loops
    std::size_t near = 0;                ///< points of the rings that are asked for, which
                                         ///< come first
    std::vector<Polygon> borders;        ///< the loops, as indices into points
    std::vector<std::uint32_t> inner_of; ///< per border edge, in the order of points:
                                         ///< the third corner of its triangle
};

/// Rings of triangles around a hole whose corners are data.
struct RingRange {
    std::size_t rings = 5;   ///< at least
    double enough_rings = 0; ///< as many, if there are not enough data before; more for an estimate
};

/// Collects the corners of rings of triangles around the loops, as far as they are a graph
/// over x and y. Errors: unsupported if those next to the border are not; interrupted.
Result<KrigingData> collect_data(const Surface& surface, std::span<const BorderLoop* const> loops,
                                 const RingRange& range, const Run& run = {});

/// Places points a mesh size apart within the outer polygon, at least 0.7 mesh sizes from any
/// border; at most about `most`: the spacing doubles away from the borders where there would be
/// more. (Points within inner polygons do no harm and are not excluded.) Some are missing where a
/// stop is requested.
std::vector<Point3> places_within(std::span<const Point3> points, std::span<const Polygon> borders,
                                  double mesh_size, std::size_t most,
                                  const std::stop_token& stop = {});

/// Computes the signed area seen along z.
double signed_area(std::span<const Point3> points, const Polygon& polygon);

/// Tells whether a place is inside, by counting crossings; on the border either answer is possible.
bool is_inside(std::span<const Point3> points, const Polygon& polygon, double x, double y);

} // namespace terrane::kriging::detail
