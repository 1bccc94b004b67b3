// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The constant of the names of blocks.
#pragma once

namespace terrane::structure::detail {

struct BlockNameConstants {
    /// Least share of a surface's area at a block to be named above, below or beside it. Larger:
    /// shorter names, of which more are equal.
    double least_share = 0.1;
};
inline constexpr BlockNameConstants block_name_constants;

} // namespace terrane::structure::detail
