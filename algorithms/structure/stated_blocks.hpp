// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Blocks that a file states, such as the regions of a GOCAD model, and the blocks that they are.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Triangles of a surface that border a stated block.
struct StatedBorder {
    SurfaceId surface{};              ///< of the input
    std::uint32_t first_triangle = 0; ///< number in that surface
    std::uint32_t triangle_count = 0; ///< of triangles that follow each other

    friend auto operator<=>(const StatedBorder&, const StatedBorder&) = default;
};

/// A block that a file states.
struct StatedBlock {
    std::string name;                    ///< as in the file
    std::string layer{};                 ///< name of the layer that it is part of; empty: none
    std::vector<StatedBorder> borders{}; ///< around it; none that has the block on both sides
};

/// Finds for each block the stated one that it is, or a part of: the index of that of whose borders the
/// block's boundary consists, as far as it is a stated border; UINT32_MAX if there is none, for
/// instance for a block of several stated ones. Of several such ones it is the one whose borders
/// have the most in common with the boundary of the block, the first among equals. Files differ in
/// what the front of a border is, so that sides do not count. A hundredth of the area is left to
/// gaps and to the effect of rounding on the file. Cost: linear.
std::vector<std::uint32_t> match_blocks(const Arrangement& arrangement, const Volumes& volumes,
                                        std::span<const StatedBlock> stated);

} // namespace terrane
