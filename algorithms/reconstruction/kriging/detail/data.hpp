// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What lies round a hole of a surface z = f(x, y), and where new points go in it. Private to
// filling.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/triangulation/planar.hpp>

namespace terrane::detail {

/// Points of the surface near a hole.
struct KrigingData {
    std::vector<Point3> points;                      ///< distinct; the border's come first, in the
                                                     ///< order of the loops
    std::vector<Polygon> borders;                    ///< the loops, by indices into points
    std::vector<std::array<std::uint32_t, 2>> edges; ///< of the triangles near, lower index first
    std::vector<std::uint32_t> inner_of;             ///< per border edge, in the order of points:
                                                     ///< the third corner of its triangle
    double noise = 0; ///< mean square by which heights miss parabolas through points near
};

/// Corners of `rings` rings of triangles round the loops, as far as they are a graph over x and y.
/// Errors: unsupported where those next to the border are none.
Result<KrigingData> collect_data(const Surface& surface, std::span<const BorderLoop* const> loops,
                                 std::size_t rings);

/// Places a mesh size apart within the outer polygon (others are not looked at: points within them
/// do no harm) and 0.7 mesh sizes from any border, at most about `most`: sizes double away from
/// the borders where there would be more.
std::vector<Point3> places_within(std::span<const Point3> points, std::span<const Polygon> borders,
                                  double mesh_size, std::size_t most);

/// Signed area seen along z.
double signed_area(std::span<const Point3> points, const Polygon& polygon);

/// Whether a place is inside, by crossings; on the border either answer.
bool is_inside(std::span<const Point3> points, const Polygon& polygon, double x, double y);

} // namespace terrane::detail
