// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Joins a filling that extends beyond the border of a hole to the surface with the hole.
//
// Steps (numbers as in the paper):
//   (1) S_bound: two points at each border vertex, at a distance d up and down the normal; a strip
//       of two triangles per border edge (detail/curve.hpp);
//   (2) the exact arrangement of S_bound and the filling; the edges that both share are the curve.
//       It must contain one closed line that passes all walls of the strip once, in order;
//   (3) the triangles of the filling in the arrangement, which have that line as edges;
//   (4) the inner part: the triangles connected to the inner side of the line without crossing it.
//       It must be a disk, or a disk with one hole per island;
//   (5) conforming rows: the points where the line crosses the normals become the border vertices.
//       The other points of the line are removed one after the other, and so are vertices of the
//       filling that are nearer to the border than `clearance` allows. The star of each is
//       retriangulated with the best shapes (disk_mesh.hpp), so no border edge is divided.
// Guarantees: the triangles of the surface come first and do not change; border vertices and
// interpolated vertices keep their coordinates, bit by bit; each border edge of the hole gets one
// new triangle, oriented like the surface. An exact check ensures that no new triangle meets
// another one, new or old, other than in a shared vertex or edge, and that none is degenerate.
// Cost: the arrangement, which is linear away from the strip, and O(b log b) for b border edges.
// Source: the paper, 4.1 "Joining".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/search/method.hpp>

namespace terrane {

/// Options of join_filling().
struct JoinOptions {
    double strip = 0; ///< d, the half width of S_bound, unit of the surface; 0: half the median
                      ///< border edge; if that fails, an eighth of it, then larger ones, up to four
                      ///< times it
    double clearance = 0.5; ///< vertices of the filling are removed if they are nearer to a border
                            ///< edge than this share of its length (or of the median edge of the
                            ///< filling, if less)
    Search search = Search::mixed;       ///< does not change the result
    std::span<const BorderLoop> loops{}; ///< all loops of the surface: parts that are connected to
                                         ///< nothing and lie in the hole (islands) are joined, too
};

/// Describes the joined part. Lengths and areas are in the unit of the surface, in floating point.
struct JoinReport {
    double strip = 0;                 ///< half width used
    std::size_t curve_vertices = 0;   ///< vertices of the line that the strip cuts into the filling
    std::size_t inside_triangles = 0; ///< triangles of the filling inside of the line
    std::size_t given_way = 0;        ///< vertices removed because they were too near to the border
    std::size_t new_vertices = 0;     ///< that the surface did not have
    std::size_t new_triangles = 0;    ///< that the surface did not have
    double area = 0;                  ///< of the new triangles
    std::size_t islands = 0;          ///< islands that were joined
    double largest_step = 0;          ///< largest distance of the filling from a border vertex
};

/// A surface with its filling.
struct Joined {
    Surface surface; ///< vertices and triangles of the surface, then the new ones
    std::vector<std::uint32_t> filling_vertices; ///< per new vertex: its index in the filling
    JoinReport report;                           ///< how they were joined
};

/// Joins a filling to the hole `loop`, which must be one of find_border_loops(surface). Only the
/// connected part of the filling around the border matters. Errors: bad_number, bad_index;
/// bad_option (an invalid loop, an option out of range); not_closed (the strip does not cut the
/// filling in one closed line around the hole; the error names the border vertex); improper_contact
/// (the filling crosses itself or the surface; the error names the place); interrupted,
/// out_of_memory.
Result<Joined> join_filling(const Surface& surface, const BorderLoop& loop, const Surface& filling,
                            const JoinOptions& options = {}, const Run& run = {});

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> join_constants();

} // namespace terrane
