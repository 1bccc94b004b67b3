// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R26 and R53 to R57 of the verifier: surfaces that were sealed or extended. The exact part
// is the arrangement of all surfaces with the triangles that were added to them. Of these, and of
// the given ones, some exact triangles were left out.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// Checks that there is one part per surface, with finite numbers (R53), and that no limit is above
/// the largest that is accepted (R26).
void check_sealed_lists(const SealedClaim& sealed, std::size_t surfaces, double accepted,
                        Violations& found);

/// Returns the surfaces of the files with the triangles added to them: first the extended
/// triangles, then those that seal, each with three vertices. Precondition: R53 holds.
std::vector<Surface> grown_surfaces(std::span<const Surface> files, const SealedClaim& sealed);

/// The exact part and its relation to the inputs, for the rules about it.
struct SealedParts {
    std::span<const Surface> surfaces; ///< grown, then the boundary of a volume
    std::span<const Surface> files;    ///< as given, without the boundary
    const SealedClaim& sealed;
    const ArrangementClaim& exact;
    const Numbers& dropped;           ///< exact triangles
    const std::vector<bool>& outside; ///< per exact triangle: outside of the volume of interest
};

/// Checks the exact part. Call a triangle given for a surface if a given triangle of this contains
/// it, and added if only added triangles contain it. A dropped triangle inside is trimmed, where it
/// is given.
/// (1) R26: each kept triangle that lies in a surface without being given for it is within the
///     limit of the given triangles of this surface; each trimmed triangle is within it of what is
///     given and not trimmed. So the surface as it was and as it is are nowhere farther apart.
/// (2) R54: each added triangle goes on from the border of its surface, which has the extended ones
///     where triangles seal: it has a side, from vertex to vertex, in common with the only triangle
///     there, or with an added one of the same list for which this holds; and the two pass it in
///     opposite directions, so that they face the same side. Or it is the end of a strip that was
///     left alone, with one vertex of its surface. It is no given triangle of another surface. What was kept of added triangles is connected, over edges and within their surface,
///     with given triangles of it that are not trimmed. A way may lead through the outside of the
///     volume.
/// (3) R55: an edge at which only an added triangle was kept lies on a side of an added triangle
///     from a vertex that its surface had before.
/// (4) R56: no edge with a trimmed triangle is left with a single one. Each trimmed part is
///     connected with a part of its surface that is not trimmed.
/// That added triangles meet another surface, or close a gap, is not judged.
/// Precondition: R1 to R8, R51 and R53 hold.
void check_sealed(const SealedParts& parts, Violations& found);

/// Checks that doubles with other triangles than those of the exact part lie only where something
/// was kept (R57): the triangles that name an input triangle have at most the area of what was kept
/// of it, up to the deviation times the lengths of all edges. Where the triangles are those of the
/// exact part nothing is to be shown. `kept` is the exact part without its dropped triangles.
void check_only_kept(std::span<const Surface> surfaces, const ArrangementClaim& kept,
                     const RoundedClaim& rounded, const std::vector<bool>& is_cut,
                     Violations& found);

} // namespace terrane::verifier
