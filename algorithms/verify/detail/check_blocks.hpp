// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The rules R30 to R34 of the verifier: blocks.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/verify/certificate.hpp>
#include <terrane/algorithms/verify/detail/blocks.hpp>
#include <terrane/algorithms/verify/detail/tetrahedra.hpp>

namespace terrane::verifier {

/// The blocks of the mesh of doubles, by the numbers that they have among those of the exact
/// arrangement.
struct NumberedBlocks {
    std::uint32_t exact = 0;        ///< number of blocks of the arrangement
    std::size_t filled = 0;         ///< number of blocks of the mesh
    std::vector<Numbers> shells;    ///< per shell: its sides
    Numbers block_of_shell;         ///< per shell
    Numbers around;                 ///< per shell, as in BlocksClaim
    std::vector<BlockSides> sides;  ///< per triangle
    std::vector<mpq_class> volumes; ///< per block; [0] of all; unit of the input, cubed
};

/// Finds the blocks of both meshes and matches them. Precondition: both are conforming, and
/// `doubles` has integer points (w = 1).
NumberedBlocks number_blocks(const ExactMesh& exact, const ExactMesh& doubles);

/// Compares the claim with the truth.
void check_blocks(const NumberedBlocks& truth, const BlocksClaim& claim, Violations& found);

} // namespace terrane::verifier
