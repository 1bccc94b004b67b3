// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How blocks and the surfaces around them lie to each other.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::structure::detail {

/// Where a block is, seen from a surface at its boundary.
enum class BlockPosition : std::uint8_t { below, above, beside, inside, around };

/// A surface at the boundary of a block.
struct BlockContact {
    std::uint32_t surface = 0;
    double area = 0;                               ///< at the block, squared unit
    BlockPosition position = BlockPosition::below; ///< of the block
    std::string_view direction{};                  ///< beside: of the block, "northwest"
    bool is_roof = false;  ///< whether a part of the surface that counts is above the block
    bool is_floor = false; ///< whether such a part is below it
};

/// Lists the surfaces around each block, by their indices. The outside has none.
std::vector<std::vector<BlockContact>> find_contacts(const Mesh& mesh, const Volumes& volumes);

} // namespace terrane::structure::detail
