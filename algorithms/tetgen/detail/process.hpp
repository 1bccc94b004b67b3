// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs a mesher, TetGen or Gmsh, once, in a process of its own, so that its asserts, its crashes and
// its output cost the caller nothing and so that it can be stopped.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

namespace terrane::tetgen::detail {

/// A bound on the tetrahedra of a block that facets enclose.
struct BlockBound {
    Point3 place;          ///< inside the block
    double max_volume = 0; ///< largest volume of a tetrahedron, > 0
};

/// The blocks on both sides of a facet.
struct BlockSides {
    std::uint32_t front = 0;  ///< block that its front faces; no_block: outside of the domain
    std::uint32_t behind = 0; ///< likewise
};

/// A mesher's input: convex planar facets that meet in shared vertices and edges only.
struct TetgenInput {
    std::vector<Point3> points;       ///< pairwise distinct, all used
    IndexLists<std::uint32_t> facets; ///< corners of each facet, in order around it
    bool keep_facets = true;          ///< do not split facets; without bounds on sizes
    bool improve = true;              ///< flip and smooth where shapes are bad
    bool sort_points = true;          ///< insert points along a curve, not in their order
    Mesher mesher = Mesher::tetgen;   ///< not automatic; Gmsh knows improve and max_volume only
    bool parallel_delaunay = false;   ///< Gmsh's newer algorithm (HXT), which embeds no facet
    std::vector<BlockSides> sides;    ///< per facet; for Gmsh only
    std::optional<double> max_volume; ///< largest volume of any tetrahedron
    std::vector<BlockBound> blocks;   ///< bounds of single blocks
    std::vector<double> max_areas;    ///< per facet: largest area of a face, or infinite; or empty
    std::optional<double> radius_edge_ratio;
    double time_limit = std::numeric_limits<double>::infinity(); ///< seconds
    std::filesystem::path helper; ///< the program that runs the mesher
};

/// A mesher's answer. run_mesher() checks only the array lengths; assemble() checks the rest.
struct TetgenOutput {
    std::vector<Point3> points; ///< those of the input, then added ones
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<Triangle> faces;           ///< faces of tetrahedra on a facet
    std::vector<std::uint32_t> face_facet; ///< facet of each face
};

/// Runs the mesher once, in its helper program. The same input gives the same output, as each process
/// starts from the same state.
///
/// Errors: unsupported (too many facets, or facets too close to tell apart), out_of_memory,
/// interrupted (the helper is killed), timed_out (likewise), internal (the mesher failed). Errors about
/// the helper itself have its path as their place: cannot_open (it can't be run), unsupported (its
/// version differs), internal (it broke the protocol).
Result<TetgenOutput> run_mesher(const TetgenInput& input, const std::stop_token& stop);

} // namespace terrane::tetgen::detail
