// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The exact arrangement of any number of surfaces, and of each with itself.
//
// Guarantees: the points are pairwise distinct; two triangles share a vertex, an edge, or nothing;
// each input triangle with area is exactly the union of the triangles that name it as a parent. No
// epsilon. The result depends on neither threads nor search method.
// Cost: the box search, plus what touches: O(n log n) for surfaces that meet along curves.
// Source: the paper, sections 2 and 3 (intersection, inclusion of the curve).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/detail/intersection_edges.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Options of arrange().
struct ArrangeOptions {
    Search search = Search::automatic; ///< how candidates are found; never changes the result
};

/// What was done, for people and benchmarks.
struct ArrangeStatistics {
    std::size_t candidates = 0;         ///< pairs of triangles whose boxes overlap
    std::size_t improper_contacts = 0;  ///< pairs of input triangles that meet improperly
    std::size_t divided = 0;            ///< input triangles that were triangulated
    std::size_t constructed_points = 0; ///< distinct points that are no input vertices
    PredicateCounts predicates;         ///< signs decided by each stage
    double seconds_prepare = 0;         ///< for the soup and the injective patches
    double seconds_search = 0;          ///< for candidate pairs
    double seconds_intersect = 0;       ///< for contacts and their points
    double seconds_triangulate = 0;     ///< for the triangulation of faces
    double seconds_stitch = 0;          ///< for vertices, parents and intersection edges
};

/// Input vertices and triangles are counted through all surfaces: vertex k of surface s is
/// (vertices of the surfaces before s) + k; triangles likewise.
struct Arrangement {
    std::vector<SurfaceInfo> surfaces;     ///< order of the input
    InputTriangles inputs;                 ///< how input triangles are counted; duplicates
    PointStore points;                     ///< all input vertices, and all constructed points
    std::vector<PointIndex> vertices;      ///< the points in use: input ones by number, then
                                           ///< constructed ones in lexicographic order
    std::vector<Triangle> triangles;       ///< indices into vertices; unique; oriented as the first
                                           ///< parent
    IndexLists<std::uint32_t> parents_of;  ///< per triangle: all input triangles that contain it,
                                           ///< duplicates too; sorted, >= 1 (> 1: coplanar overlap)
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: surfaces of its parents, sorted, >= 1
    std::vector<Edge> intersection_edges;  ///< in which more than two triangles meet, or two that
                                           ///< differ in their number of distinct parents in some
                                           ///< surface; sorted, unique. The parents of an edge
                                           ///< are those of the triangles at it
    std::vector<std::uint32_t> degenerate; ///< input triangles without area, ascending
    InjectivePatches patches;              ///< of the triangles: within one, none meet improperly
    std::vector<CandidatePair> neighbours; ///< input triangles, one of them with constructed
                                           ///< points, not both within one patch, that meet or may
                                           ///< do so when points are rounded to nearest doubles;
                                           ///< no duplicates; sorted
    Adjacency adjacency;                   ///< of the triangles, for what follows
    bool whole = true;                     ///< false: some triangles were taken out, see
                                           ///< restricted.hpp
    /// Takes the same out of an arrangement of the same surfaces after a small move of their
    /// vertices: rounding needs it where it arranges anew. Empty where `whole`, or not known.
    std::function<Result<Arrangement>(Arrangement, const Run&)> restrict_again{};
    ArrangeStatistics statistics; ///< what was done
};

/// Errors: bad_number (a coordinate is not finite), bad_index, interrupted, out_of_memory.
Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options = {},
                            const Run& run = {});

} // namespace terrane
