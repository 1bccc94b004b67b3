// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The independent verifier uses GMP rationals and value types only. It shares no predicate, search
// structure or arrangement code with the producer; a test checks its includes.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/verdict.hpp>

namespace terrane {

/// Returns all violations of the rules, sorted by rule and elements; none if the claim is true.
/// (1) Any claim is judged, whatever it contains. After a violation of R1 or R2 the following rules
///     are not judged.
/// (2) R5: the intersection of two triangles, as closed sets, must be the convex hull of the
///     vertices that they share: nothing, a vertex or an edge.
/// (3) R7: an edge is an intersection edge iff more than two triangles meet in it, or if it has two
///     triangles that differ in the number of geometrically distinct parents in some surface.
/// (4) R20: the local structure at a vertex consists of the planes and the edges of the input
///     triangles through it. It is a meeting iff no direction lies in all of these planes and along
///     all of these edges; so the vertices of a true claim are determined by the inputs.
/// (5) R8: triangles without area are degenerate and are not compared for duplicates; points are
///     equal if their coordinates are equal, whatever their indices.
///
/// Cost: O(n log n + k) for k pairs of triangles whose boxes touch, with an exact test each.
/// 100 000 triangles take about a second.
std::vector<Violation> verify_arrangement(std::span<const Surface> inputs,
                                          const ArrangementClaim& claim);

/// Returns all violations of R1, R3, R4 and R5 in a mesh of doubles, judged by rationals. After a
/// violation of R1 the other rules are not judged.
std::vector<Violation> verify_conforming(std::span<const Point3> vertices,
                                         std::span<const Triangle> triangles);

} // namespace terrane
