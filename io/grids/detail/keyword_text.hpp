// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values of Eclipse's keywords.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace terrane::grids::detail {

inline constexpr std::size_t longest_line = 78; ///< Eclipse reads 128 characters

/// Appends a keyword and a value for each element; a value that follows itself is repeated, as in 3*1.
template <class Elements, class ValueOf>
void append_keyword(std::string& out, std::string_view keyword, const Elements& elements,
                    const ValueOf& value_of) {
    out += keyword;
    std::string line;
    const auto end_line = [&] {
        out += '\n' + line;
        line.clear();
    };
    for (std::size_t c = 0; c < elements.size();) {
        const auto value = value_of(elements[c]);
        std::size_t end = c;
        while (end < elements.size() && value_of(elements[end]) == value) ++end;
        const auto word =
            end - c == 1 ? fmt::format(" {}", value) : fmt::format(" {}*{}", end - c, value);
        if (line.size() + word.size() > longest_line) end_line();
        line += word;
        c = end;
    }
    end_line();
    out += "\n/\n";
}

} // namespace terrane::grids::detail
