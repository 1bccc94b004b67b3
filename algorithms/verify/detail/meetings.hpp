// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R19 and R20 of the verifier: which way triangles face, and which points are vertices.
#pragma once

#include <span>

#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/contacts.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// An arrangement as it is claimed, with the exact points of its inputs and of its vertices.
struct ExactParts {
    const Inputs& inputs;
    std::span<const Vector4> input_points; ///< per vertex of the inputs
    const SetAside& set_aside;
    const ArrangementClaim& claim; ///< its indices are in range
    const ExactMesh& mesh;         ///< the vertices and triangles of the claim
};

/// Reports the triangles whose normal points away from that of their first parent (R19).
void check_orientation(const ExactParts& parts, Violations& found);

/// Reports the vertices that the inputs do not force (R20). Precondition: the claim violates none
/// of R3 to R6. By R5 and R6, the parents of the triangles at a vertex are all input triangles that
/// contain it. The vertex is forced if it is a corner of one of them, or if no direction lies in
/// the planes of all of them and along all of their edges that contain it. Otherwise
/// each parent continues on both sides along such a direction, so nothing requires a vertex there.
/// Cost: a few products of integers for each vertex and each parent there.
void check_meetings(const ExactParts& parts, Violations& found);

} // namespace terrane::verifier
