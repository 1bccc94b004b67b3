// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rules R22 to R27 of the verifier: an improved mesh and the mesh before.
#pragma once

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>
#include <terrane/algorithms/verify/detail/sheets.hpp>

namespace terrane::verifier {

/// Checks indices, numbers and limits (R22), and whether the limits are accepted (R26).
void check_improved_numbers(const ImprovedClaim& improved, std::size_t surfaces, double accepted,
                            Violations& found);

/// Checks that an improved mesh is conforming (R23), that it has the sheets and curves of the mesh
/// before (R24, R25), that both are within the limits of each other (R26), and that sheets face
/// the side that they faced (R27).
/// Precondition: check_improved_numbers() found nothing; the mesh before is conforming.
///
/// (1) Each point of a sheet is within the least limit of its surfaces of the same sheet of the
///     other mesh; each point of a chain of curves within the least limit of the sheets there of
///     the chains with the same corners and the same sheets.
/// (2) The sheets have the same number of components and the same Euler characteristic, so their
///     shapes are equal as far as the number of holes and handles tells.
/// (3) A sheet whose triangles agreed on a side before faces the same side: its vector area points
///     the same way or, if that is zero as for a closed sheet, its volume has the same sign.
void check_improved(const LabelledMesh& before, const ImprovedClaim& improved, Violations& found);

} // namespace terrane::verifier
