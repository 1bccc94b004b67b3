// SPDX-License-Identifier: LGPL-3.0-or-later
//
// TetGen at arm's length: run in a child process, so that its asserts, its crashes and what it
// prints cost the caller nothing, and so that it can be stopped. Private to terrane::tetgen.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// A bound on the tetrahedra of what facets enclose.
struct RegionBound {
    Point3 place;          ///< inside of it
    double max_volume = 0; ///< of a tetrahedron, > 0
};

/// What TetGen gets: convex planar facets that meet in shared vertices and edges only.
struct TetgenInput {
    std::vector<Point3> points;       ///< pairwise distinct, all used
    IndexLists<std::uint32_t> facets; ///< per facet its corners, in order around it
    bool keep_facets = true;          ///< split none: not with any of the last four
    bool improve = true;              ///< flip and smooth where shapes are bad
    bool sort_points = true;          ///< insert them along a curve, not as they come
    std::optional<double> max_volume; ///< of a tetrahedron, anywhere
    std::vector<RegionBound> regions; ///< what other bounds there are
    std::vector<double> max_areas;    ///< per facet: of a face on it, infinite: no bound; or empty
    std::optional<double> radius_edge_ratio;
    double time_limit = std::numeric_limits<double>::infinity(); ///< seconds
};

/// What TetGen says. Nothing is checked but the array lengths.
struct TetgenOutput {
    std::vector<Point3> points; ///< those of the input, then added ones
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<Triangle> faces;           ///< faces of tetrahedra on a facet
    std::vector<std::uint32_t> face_facet; ///< per face: its facet
};

/// Errors: unsupported (too many, or too close to tell apart), out_of_memory, interrupted (the
/// child is killed), timed_out (likewise), internal. The same input gives the same output: each
/// child starts from the same state.
Result<TetgenOutput> run_tetgen(const TetgenInput& input, const std::stop_token& stop);

} // namespace terrane
