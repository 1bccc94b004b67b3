// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Readers of files with tetrahedra, for rule R21. Each follows a file from its first byte to its
// last, as Terrane writes it, and compares it with the tetrahedra of the certificate. They share no
// code with their writers.
#pragma once

#include <span>
#include <string_view>

#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/inputs.hpp>

namespace terrane::verifier {

/// The tetrahedra that a file must hold.
struct ExpectedTetrahedra {
    const TetrahedraClaim& claim;
    std::span<const SurfaceInfo>
        surfaces; ///< what the file calls them; "box" last, if there is one
    IndexLists<std::uint32_t> surfaces_of; ///< per face: those of its triangle, or the box
};

/// The side of a cut on which a face is: 1 in front, 2 behind, 0 if it has no twin.
std::vector<std::int32_t> cut_sides(const TetrahedraClaim& claim);

// All throw a Difference.
void compare_vtu(std::string_view contents, const ExpectedTetrahedra& expected);
/// The names of blocks are not compared.
void compare_msh(std::string_view contents, const ExpectedTetrahedra& expected);
void compare_msh22(std::string_view contents, const ExpectedTetrahedra& expected);

} // namespace terrane::verifier
