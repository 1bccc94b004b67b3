// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R63, R65 and R66 of the verifier for layers with a minimum thickness D.
//
// The promise: at a place where the surface of a layer has height s, and where A and B are the
// heights of the lowest harder layer above and of the highest harder layer below in the order that
// exist there, the layer has height
//   h = min(A, max(B + D, min(s, A - D))).
// So it keeps to its surface, at a distance D from harder layers; where these leave less room than
// D, it lies on the one above.
//
// Statement: z = h exactly if none of these holds; without A or B a condition about it is false
// where it is about "some" and true where it is about "all" layers:
//   (1) z > s, and z > b + D for all b below;
//   (2) z < s, and z < a - D for all a above;
//   (3) z > a - D for some a above, and z > b + D for all b below;
//   (4) z < b + D for some b below, and z < a for all a above;
//   (5) z > a for some a above, which is R62.
// Proof: z <= h means z <= A, and z <= B + D or else z <= s and z <= A - D: not (1), (3), (5).
// z >= h means z >= A, or else z >= B + D and z >= s or z >= A - D: not (4), and not (2), whose z <
// s and z < A - D, with z < A, is what is left.
#pragma once

#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/layered_sheets.hpp>

namespace terrane::verifier {

/// Checks the triangles of all layers. Let d be the stated deviation, and L the largest slope,
/// |dz/dx| + |dz/dy|, of the surfaces of the layer and of harder ones near a place.
/// R63: each triangle of a layer is within d of its surface, or of that of a harder layer moved
///     along z by a multiple of D. For no part of it (1) or (2) holds by more than d (1 + L).
/// R65: it faces up or down as one of the surfaces within d of it does, moved in this way. Triangles
///     that face aside are exempt, as in layered.hpp.
/// R66: for no part of it (3) or (4) holds by more than d (1 + L).
/// Parts within 2 d of borders of surfaces are exempt, as in R62. All heights are linear over the
/// common part of the projections of two triangles. There the places where, say, z > a - D by more
/// than the slack are a convex polygon; those of all b below where not z > b + D are removed from
/// it, and nothing may be left. All of this is decided exactly.
///
/// A point of the mesh that is at most d / 2 away from where it must be is at most (1 + L) d / 2
/// above or below the right height, and (1) to (4) compare two such heights. Nothing in the slack
/// depends on the mesh that is judged. Precondition: D > 0. Cost: O(n log n + k) for k pairs
/// of triangles over each other.
void check_thickness(const LayerSheets& sheets, Violations& found);

} // namespace terrane::verifier
