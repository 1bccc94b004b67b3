// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Dissolves blocks into neighbours without moving anything: the rest of thin blocks where they
// were zipped in part, and thin blocks where that was asked for.
//
// A block is dissolved by removing its largest interface, the triangles between it and one neighbour
// that belong to the same surfaces. These surfaces then run along all other sides of the block
// instead, so they stay as whole as they were, and move by its thickness at most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::simplification::detail {

/// Twice the volume of each block, divided by the area around it.
std::vector<double> thicknesses(const Mesh& mesh, const Volumes& volumes);

/// Dissolves blocks in the cells of a mesh, as long as they do not touch one another. Returns how
/// many it dissolved; blocks that have no interface but the boundary and the outside stay, unless they
/// were outside themselves. `block_before`: per volume, the one that it was.
std::size_t dissolve(const Mesh& mesh, const Volumes& volumes,
                     std::span<const std::uint32_t> blocks,
                     std::span<const std::uint32_t> block_before, std::vector<Cell>& cells);

} // namespace terrane::simplification::detail
