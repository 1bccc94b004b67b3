// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grdecl_cells.hpp>

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <terrane/io/text/names.hpp>

namespace terrane {

namespace {

constexpr std::size_t longest_line = 78; ///< Eclipse reads 128 characters

template <class ValueOf>
void append_keyword(std::string& out, std::string_view keyword,
                    std::span<const std::uint32_t> blocks, const ValueOf& value_of) {
    out += keyword;
    std::string line;
    const auto end_line = [&] {
        out += '\n' + line;
        line.clear();
    };
    for (std::size_t c = 0; c < blocks.size();) {
        const std::uint32_t value = value_of(blocks[c]);
        std::size_t end = c;
        while (end < blocks.size() && value_of(blocks[end]) == value) ++end;
        const auto word =
            end - c == 1 ? fmt::format(" {}", value) : fmt::format(" {}*{}", end - c, value);
        if (line.size() + word.size() > longest_line) end_line();
        line += word;
        c = end;
    }
    end_line();
    out += "\n/\n";
}

} // namespace

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
