// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes the exact arrangement of any number of surfaces, which may also intersect themselves.
//
// Guarantees: the points are pairwise distinct; two triangles share a vertex, an edge, or nothing;
// each input triangle with area is exactly the union of the triangles that name it as a parent.
// There is no epsilon. The result depends on neither threads nor search method.
// Cost: that of the box search, plus that of the triangles that meet: O(n log n) for surfaces that
// meet along curves.
// Source: the paper, sections 2 and 3 (intersection, inclusion of the curve).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/search/method.hpp>
#include <terrane/kernel/point.hpp>
#include <terrane/kernel/predicate_counts.hpp>

namespace terrane {

/// The numbering of input triangles and input vertices through all surfaces.
struct InputTriangles {
    std::vector<std::uint32_t> first;        ///< per surface: its first triangle; then the total
    std::vector<std::uint32_t> first_vertex; ///< per surface: its first vertex; then the total
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {input triangle, the first with the
                                                          ///< same three points}, ascending

    /// Returns the surface of an input triangle.
    [[nodiscard]] SurfaceId surface_of(InputTriangleId triangle) const;
    /// Returns the first triangle with the same three points: itself if it is no duplicate.
    [[nodiscard]] InputTriangleId first_same(InputTriangleId triangle) const;
};

/// Options of arrange().
struct ArrangeOptions {
    Search search = Search::automatic; ///< method that finds candidates; never changes the result
};

/// Counts of the steps. A part of an arrangement keeps those of the whole.
struct ArrangeStatistics {
    Search search = Search::automatic; ///< method that found the candidates; automatic if none did
    std::size_t candidates = 0;        ///< pairs of triangles whose boxes overlap
    std::size_t known = 0; ///< candidates that need no test, as an earlier arrangement tested them
    std::size_t improper_contacts = 0;  ///< pairs of input triangles that meet improperly
    std::size_t divided = 0;            ///< input triangles that were triangulated
    std::size_t constructed_points = 0; ///< distinct points that are no input vertices
    std::size_t triangles = 0;          ///< of the result
    std::size_t vertices = 0;           ///< of the result
    PredicateCounts predicates;         ///< signs decided by each stage
};

/// The exact points of an arrangement and the data that later stages need. It is opaque to users of
/// the library; the internal header exact_arrangement.hpp defines it.
struct ExactState;

/// Returns the state of an arrangement without surfaces.
std::shared_ptr<const ExactState> empty_state();

/// The arrangement of surfaces. Input vertices and triangles are numbered through all surfaces:
/// vertex k of surface s is (vertices of the surfaces before s) + k; triangles likewise.
struct Arrangement {
    std::vector<SurfaceInfo> surfaces;     ///< in the order of the input
    InputTriangles inputs;                 ///< numbering and duplicates of the input triangles
    std::vector<PointIndex> vertices;      ///< the points in use: input points by number, then
                                           ///< constructed points in lexicographic order
    std::vector<Triangle> triangles;       ///< indices into vertices; unique; oriented as the first
                                           ///< parent
    IndexLists<std::uint32_t> parents_of;  ///< per triangle: all input triangles that contain it,
                                           ///< including duplicates; sorted, >= 1 (> 1: coplanar
                                           ///< overlap)
    IndexLists<std::uint32_t> surfaces_of; ///< per triangle: surfaces of its parents, sorted, >= 1
    std::vector<Edge> intersection_edges;  ///< edges of more than two triangles, or of two that
                                           ///< differ in their number of distinct parents in some
                                           ///< surface; sorted, unique. The parents of an edge
                                           ///< are those of its triangles
    std::vector<std::uint32_t> degenerate; ///< input triangles without area, ascending
    ArrangeStatistics statistics;          ///< counts
    std::shared_ptr<const ExactState> state = empty_state(); ///< never null; shared by copies

    /// Returns the doubles nearest to a vertex (an index into vertices).
    [[nodiscard]] const Point3& nearest(VertexId vertex) const;
    /// Returns the exact coordinates of a vertex as reduced fractions: "-5/3", "7".
    [[nodiscard]] std::array<std::string, 3> coordinates(VertexId vertex) const;
    /// Returns how a vertex is constructed from input vertices.
    [[nodiscard]] Construction construction(VertexId vertex) const;
    /// Returns all input vertices, used or not.
    [[nodiscard]] std::span<const Point3> input_vertices() const;
    /// Returns the corners of all input triangles; each corner is the first input vertex with the
    /// same coordinates.
    [[nodiscard]] std::span<const Triangle> input_corners() const;
};

/// Computes the arrangement of surfaces. Errors: bad_number (a coordinate is not finite),
/// bad_index, unsupported (indices beyond 32 bits), interrupted, out_of_memory, internal.
/// Times: arrange, with the steps prepare (soup and injective patches), search (candidate pairs),
/// intersect (contacts and their points), triangulate (faces), stitch (unique triangles) and
/// assemble (vertices, parents, intersection edges).
Result<Arrangement> arrange(std::span<const Surface> surfaces, const ArrangeOptions& options = {},
                            const Run& run = {});

// Computes the canonical digest of an arrangement: a hash of its geometry that does not depend on
// numbering, nor on the choice between diagonals that a triangulation may use alike. Indices, the
// order of files, surfaces, triangles and corners, orientation, threads and search method do not
// change it; neither do reflections, exchanges of axes and scalings by powers of two that are
// undone afterwards. Any other point, parent, number of triangles or intersection edge changes it.
//
// Definition. H is SHA-256, its value 32 bytes; lists of hashes are sorted as bytes and joined.
//   number      a reduced fraction in lower-case hexadecimal: "-1f/4"; "/1" is omitted
//   point       H("x y z") of three numbers
//   input       H("input" + list of the points of an input triangle's corners + its surface's name)
//   vertex      H("vertex" + point + list of the inputs of all parents of the triangles at it)
//   parent      H("parent" + input + decimal number of the triangles that name it), for each input
//               triangle that at least one triangle names
//   edge        H("edge" + list of the points of its ends), for each intersection edge
//   degenerate  H("degenerate" + input), for each input triangle without area
//   duplicates  H("duplicates" + list of inputs), for each set of input triangles with the same
//               three points
//   digest      "sha256:" + hexadecimal of H("terrane-digest 1\n" + list of all vertices, parents,
//               edges, degenerate and duplicates)
// The verifier has an implementation of its own (algorithms/verify/detail/digest.hpp).

/// Returns the digest of the arrangement of `inputs`. A stop request of the run is ignored. Cost:
/// n log n; half a second for 100 000 triangles.
std::string canonical_digest(std::span<const Surface> inputs, const Arrangement& arrangement,
                             const Run& run = {});

} // namespace terrane
