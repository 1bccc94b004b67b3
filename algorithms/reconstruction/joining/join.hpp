// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Joins a surface that fills a hole, and goes beyond its border, to the surface with the hole.
//
// Steps (numbers as in the paper):
//   (1) S_bound: at each border vertex two points at a distance d along the normal, up and down; a
//       strip of two triangles per border edge (join_curve.hpp);
//   (2) the exact arrangement of S_bound and the filling; the edges that both share are the curve.
//       It must hold one closed line that passes all walls of the strip once and in order;
//   (3) the filling's triangles of the arrangement, which contain that line as edges;
//   (4) the part inside: diffusion from the line's inner side, stopped at it. It must be a disk,
//       or one with a hole for each island;
//   (5) conforming rows: the points where the line crosses the normals become the border's
//   vertices,
//       the others of the line are taken out one after the other, and so are vertices of the
//       filling that are nearer to the border than `clearance` allows. What is left open by each is
//       filled anew with the best-shaped triangles (disk_mesh.hpp). So no edge of the border is
//       divided.
// Guarantees: the triangles of the surface stay, first and unchanged; the border keeps its
// vertices, bit by bit; every new vertex is one of the filling's, bit by bit; each border edge of
// the hole has one new triangle, wound as the old ones along the loop. By exact check no new
// triangle meets another triangle, new or old, other than in a shared vertex or edge, and none is
// degenerate. Cost: the arrangement, which is linear where the strip does not reach, and O(b log b)
// for the band. Source: the paper, 4.1 "Joining".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane {

struct JoinOptions {
    double strip = 0; ///< d, the half width of S_bound, unit of the surface; 0: half the median
                      ///< border edge, and where that fails an eighth of it, then wider ones, up
                      ///< to four times it
    double clearance = 0.5; ///< a vertex of the filling nearer to a border edge than this share of
        ///< the edge's length (or of the filling's own edges, if less) gives way
    Search search = Search::mixed;       ///< never changes the result
    std::span<const BorderLoop> loops{}; ///< all of the surface: what hangs together with the rest
                                         ///< nowhere and lies in the hole, an island, is joined too
};

/// Lengths and areas: unit of the surface, in floating point.
struct JoinReport {
    double strip = 0;                 ///< the half width used
    std::size_t curve_vertices = 0;   ///< of the line that the strip cuts into the filling
    std::size_t inside_triangles = 0; ///< of the filling, within the line
    std::size_t given_way = 0;        ///< vertices of the filling that were too near to the border
    std::size_t new_vertices = 0, new_triangles = 0;
    double area = 0;         ///< of the new triangles: what was invented
    std::size_t islands = 0; ///< that were joined, too
    double largest_step = 0; ///< how far the filling passes from a border vertex at most
};

struct Joined {
    Surface surface; ///< vertices and triangles of the surface, then the new ones
    std::vector<std::uint32_t> filling_vertices; ///< per new vertex: which one of the filling
    JoinReport report;
};

/// `loop` is one of find_border_loops(surface). Of the filling only the connected part round the
/// border matters. Errors: bad_number, bad_index; bad_option (a loop that is none, an option out of
/// range); not_closed (the strip does not cut the filling in one closed line round the hole, at the
/// border vertex named); improper_contact (the filling crosses itself or the surface, at the place
/// named); interrupted, out_of_memory.
Result<Joined> join_filling(const Surface& surface, const BorderLoop& loop, const Surface& filling,
                            const JoinOptions& options = {}, const Run& run = {});

} // namespace terrane
