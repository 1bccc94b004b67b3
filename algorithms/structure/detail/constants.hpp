// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constants of the names of blocks.
#pragma once

#include <cstddef>

namespace terrane::structure::detail {

struct BlockNameConstants {
    /// A surface is listed above, below or beside a block if at least this share of its area at the
    /// block lies there. It is in the block's name if it makes up at least this share of the area
    /// above or below the block. A larger share gives shorter names, more of which are equal.
    double least_share = 0.1;
    /// A surface is at one side of a block if the sum of its area vectors there is at least this
    /// share of its area; otherwise it is around the block, or in it. Larger: sharper folds count
    /// as closed.
    double least_resultant = 0.5;
    /// Most surfaces above a block, and below it, that its name lists. Larger: longer names.
    std::size_t most_listed = 2;
    /// Most surfaces that are added to names until they differ; a number follows if they still
    /// don't. Larger: longer names with fewer numbers.
    std::size_t most_added = 3;
};
inline constexpr BlockNameConstants block_name_constants;

struct StatedBlockConstants {
    /// Least share of the stated borders around a block that must be those of a stated block. Less: a
    /// block of several of them may get the name of one of them.
    double least_common = 0.99;
};
inline constexpr StatedBlockConstants stated_block_constants;

} // namespace terrane::structure::detail
