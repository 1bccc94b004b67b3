// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier: GMP rationals and value types only. It shares no predicate, no search
// structure and no arrangement code with the producer; a test reads its includes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/kernel/construction.hpp>

namespace terrane {

/// What an arrangement says of itself, in numbers that count through all input surfaces:
/// input vertex k of surface s is (vertices of surfaces before s) + k; triangles likewise.
struct ArrangementClaim {
    std::vector<Construction> vertices;    ///< pairwise distinct points
    std::vector<Triangle> triangles;       ///< indices into vertices; unique as sets
    IndexLists<std::uint32_t> parents_of;  ///< per triangle: all input triangles that contain it
                                           ///< (duplicates too), sorted, >= 1
    std::vector<Edge> intersection_edges;  ///< sorted, unique; see rule R7
    std::vector<std::uint32_t> degenerate; ///< input triangles without area, sorted
    std::vector<std::array<std::uint32_t, 2>> duplicates; ///< {triangle, the first one with the
                                                          ///< same three points}, sorted
};

enum class Rule : std::uint8_t {
    R1_indices,   ///< an index is out of range, a list unsorted or empty
    R2_vertices,  ///< a construction is undefined (parallel line and plane, ...)
    R3_distinct,  ///< two vertices are the same point, or a vertex belongs to no triangle
    R4_triangles, ///< a triangle without area, or two triangles with the same vertices
    R5_contacts,  ///< two triangles meet other than in a shared vertex or edge
    R6_parents,   ///< an input triangle is not exactly the union of the triangles that name
                  ///< it: a child lies outside of it, or the areas do not add up
    R7_intersection_edges, ///< listed but none, or one but not listed
    R8_set_aside,          ///< degenerate or duplicate, but not listed as such, or the reverse
    // R9 and those that follow judge a certificate: see verify_certificate.hpp.
    R9_inputs,           ///< an input file is not the one that the certificate speaks of
    R10_rounded_indices, ///< in the mesh of doubles: as R1, or a number is not finite
    R11_conforming,      ///< the doubles are not conforming, though said to be, or the reverse
    R12_rounded_parents, ///< a parent without area; an input triangle of which nothing is left, but
                         ///< not listed as vanished, or the reverse
    R13_deviation,       ///< a triangle is farther from a parent than the stated deviation
    R14_moves,           ///< a vertex is farther from its exact point than the stated largest move
    R15_rounded_edges,   ///< as R7, in the mesh of doubles
    R16_regions,         ///< regions are not what intersection edges divide the surfaces into
    R17_digest,          ///< the digest is not that of the arrangement
    R18_coverage,        ///< the triangles that name an input triangle leave a hole in it
};

/// "R5"
std::string name_of(Rule rule);

struct Violation {
    Rule rule{};
    std::vector<std::uint32_t> elements; ///< R1: what has the wrong index, empty for a whole list
                                         ///< R2, R3: vertices; R4, R5: triangles
                                         ///< R6: {input triangle}, {input triangle, triangle}, or
                                         ///<     {duplicate, first}
                                         ///< R7: the two vertices of an edge; R8: input triangles
                                         ///< R9: an input; R10, R15: as R1, R7; R11: none, or as
                                         ///< R3 to R5; R12: {input triangle} or {triangle, parent}
                                         ///< R13: {vertex, input triangle}; R14: vertex
                                         ///< R16: triangles, or none for the whole; R17: none
    std::string sentence;
};

/// Once this many pairs violate R5, those after are not searched for: the claim is refuted enough.
inline constexpr std::size_t most_contacts_listed = 100'000;

/// All violations of the rules, sorted by rule and elements; none if the claim is true.
/// (1) Whatever the claim holds, the answer is a list of violations. After one of R1 or R2 the
///     rules that follow are not judged.
/// (2) R5: two triangles may share, as closed sets, exactly the convex hull of the vertices they
///     share: nothing, a vertex or an edge.
/// (3) R7: an edge is an intersection edge iff more than two triangles meet in it, or two that do
///     differ in the number of geometrically distinct parents that they have in some surface.
/// (4) R8: triangles without area are degenerate, and not compared for duplicates; equal points are
///     equal coordinates, whatever their indices.
///
/// Cost: O(n log n + k) for k pairs of triangles whose boxes touch, an exact test each; 100 000
/// triangles take about a second.
std::vector<Violation> verify_arrangement(std::span<const Surface> inputs,
                                          const ArrangementClaim& claim);

/// All violations of R1, R3, R4 and R5 in a mesh of doubles, judged by rationals. After a violation
/// of R1 the others are not judged.
std::vector<Violation> verify_conforming(std::span<const Point3> vertices,
                                         std::span<const Triangle> triangles);

} // namespace terrane
