// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R26, R28, R29, R35 and R36 of the verifier: surfaces whose holes were filled.
#pragma once

#include <cstddef>
#include <span>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// Checks the fillings of all surfaces.
/// (1) R28: indices are in range, numbers are finite, limits are accepted. Triangles have the
///     number of a hole iff they are new, those of a filling the same, and no two fillings;
///     expected errors are 0 where vertices are given, and not negative.
/// (2) R29: the vertices and triangles of each input surface are the first ones of the filled
///     surface, to the bit.
/// (3) R35: each edge of a new triangle has two triangles, in opposite directions; one is given at
///     most, and then the edge was on the border. So the border of a filling consists of whole
///     closed borders of the surface. A filling is a disc that touches neither itself nor given
///     vertices inside. (Where given triangles face different sides, the direction along an edge of
///     a given triangle is free.) In each connected part of the
///     surface, a border as large as those that were closed stays open, by the diagonals of the
///     boxes around them; smaller ones than half of the part do not count.
/// (4) R36: new triangles have area and meet the triangles of their surface in shared vertices and
///     edges only.
/// (5) R26: a filling is connected across its edges. Its vertices lie in the box around its border,
///     widened by the limit on all sides.
void check_filled(std::span<const Surface> surfaces, const FilledClaim& filled, double accepted,
                  Violations& found);

} // namespace terrane::verifier
