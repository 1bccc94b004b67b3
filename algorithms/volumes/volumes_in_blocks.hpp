// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the volumes of a mesh that lies in blocks of space, in one process or many.
//
// Guarantees: numbers and measures are those that find_volumes() gives for the mesh of all pieces
// together, for any number of blocks.
// The blocks join the sides of their triangles round edges to shells; a shared edge is decided in one
// block. The first block joins the shells of all blocks. It holds one entry for each shell of a block,
// for each pair of shells that touch across blocks, and for each hit of a line (one line for each
// component). Cost: that of find_volumes(), divided by the number of blocks as far as triangles balance.
#pragma once

#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/distribution/supersteps.hpp>

namespace terrane {

/// Finds the volumes of the nearest doubles after arrange_in_blocks(), which must have reported a
/// conforming mesh. Returns their measures in all processes; piece_of() then tells the volumes beside each
/// triangle. Errors: internal if triangles overlap, so that the mesh is not conforming.
Result<std::vector<double>> find_volumes_in_blocks(distribution::Supersteps& blocks);

} // namespace terrane
