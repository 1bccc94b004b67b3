// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grdecl_cells.hpp>

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/grids/detail/keyword_text.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {

using grids::detail::append_keyword;

std::string cells_to_grdecl(std::span<const std::uint32_t> blocks,
                            std::span<const std::string> names, std::string_view grid) {
    std::vector<std::size_t> cells(names.size());
    for (const std::uint32_t b : blocks) ++cells[b];
    std::string out = fmt::format("-- Cells of {} in the blocks of a model: a cell is in the block "
                                  "that contains the\n-- mean of its eight corners.\n"
                                  "-- FIPNUM is the number of the block:\n",
                                  detail::one_line(grid));
    for (std::size_t b = 1; b < names.size(); ++b)
        out += fmt::format("-- {} {}: {} cell{}\n", b, detail::one_line(names[b]), cells[b],
                           cells[b] == 1 ? "" : "s");
    append_keyword(out, "ACTNUM", blocks, [](std::uint32_t b) { return std::min(b, 1U); });
    out += '\n';
    append_keyword(out, "FIPNUM", blocks, [](std::uint32_t b) { return b; });
    return out;
}

} // namespace terrane
