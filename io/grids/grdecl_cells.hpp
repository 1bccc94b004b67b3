// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writing in which block each cell of a corner-point grid lies, in Eclipse's keywords.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace terrane {

/// Returns ACTNUM, 1 for a cell in a block and 0 for any other, and FIPNUM, the number of its block.
/// `blocks` has the block of each cell in Eclipse's order, 0: none; `names` those of all blocks, of
/// which [0] is the outside. Comments say whose cells they are, in which block a cell is, and what
/// the numbers stand for. Values are repeated as in 3*1.
std::string cells_to_grdecl(std::span<const std::uint32_t> blocks,
                            std::span<const std::string> names, std::string_view grid);

} // namespace terrane
