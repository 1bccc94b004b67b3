// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R50 to R52 of the verifier: an arrangement of which a volume of interest was cut out.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// Checks that the boundary of a volume is the stated one (R50). `files` are the surfaces of the
/// input files that hold it, for a "surface".
/// (1) prism: each vertex of the boundary is a corner of the polygon at one of the two heights, and
///     all of these are vertices. Each triangle is at one of the heights, or in the wall on an edge
///     of the polygon. The boundary is closed, each edge has two triangles in opposite directions,
///     and triangles meet in shared vertices and edges only. So the horizontal sections of what it
///     bounds are bounded by edges of the polygon; they are all of it, and the volume is the prism.
///     Its triangles face outwards.
/// (2) hexahedron: its eight vertices are corners of a box, up to the rounding of their
///     coordinates, and its twelve triangles are in faces of that; it is closed, meets itself and
///     faces outwards in the same sense.
/// (3) surface: it has the vertices and triangles of the files, to the bit, and an even number of
///     triangles at each edge.
void check_volume(const VolumeClaim& volume, std::span<const Surface> files, Violations& found);

/// Returns the exact part of a claim as a mesh. `surfaces` are all that it is about. Precondition:
/// R1 and R2 hold.
ExactMesh exact_mesh_of(std::span<const Surface> surfaces, const ArrangementClaim& exact);

/// Tells which exact triangles are outside of a volume. `surfaces` are the inputs and the boundary,
/// of which there are `boundary_count` surfaces; none: nothing is outside. A triangle without a
/// parent in the boundary is inside iff a ray from a point in it meets triangles of the boundary an
/// odd number of times. Triangles that have an edge in common at which there is no triangle of the
/// boundary are on the same side. Precondition: R1 to R8 hold.
std::vector<bool> find_outside(std::span<const Surface> surfaces, std::size_t boundary_count,
                               const ArrangementClaim& exact);

/// Checks that all exact triangles outside are dropped, and others only if `inside_too` (R51).
void check_dropped(const std::vector<bool>& outside, const Numbers& dropped, bool inside_too,
                   Violations& found);

/// Checks that no triangle of the mesh of doubles is outside of the boundary in doubles (R52).
/// Precondition: R10 and R11 hold.
void check_inside(std::span<const Surface> surfaces, std::size_t boundary_count,
                  const RoundedClaim& rounded, Violations& found);

/// Returns an arrangement without some of its triangles, and without the vertices that only those
/// had. All others keep their order.
ArrangementClaim without(const ArrangementClaim& exact, const Numbers& dropped);

} // namespace terrane::verifier
