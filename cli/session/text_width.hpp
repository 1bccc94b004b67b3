// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How wide names are on a terminal, so that tables are aligned in any script.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace terrane::cli {

/// Tells whether a character changes the direction or the line of the text next to it, without being
/// seen: U+061C, U+200E and U+200F, the marks of a direction; U+2028 and U+2029; U+202A to U+202E and
/// U+2066 to U+2069, embeddings, overrides and isolates. It is written as its code, "\u202e", which
/// is code_width columns wide.
constexpr bool reorders(char32_t character) {
    return character == 0x061C || character == 0x200E || character == 0x200F ||
           (character >= 0x2028 && character <= 0x202E) ||
           (character >= 0x2066 && character <= 0x2069);
}
inline constexpr std::size_t code_width = 6;

/// Names that are wider do not widen a column; they push what follows in their own row.
inline constexpr std::size_t widest_column = 60;

/// Returns the columns of a terminal that a text in UTF-8 takes: 2 for each wide character, as those
/// of Chinese, and none for combining marks. A byte that is not UTF-8 counts as one.
std::size_t width_of(std::string_view text);

/// Returns the text with blanks behind it up to a width.
std::string padded(std::string_view text, std::size_t width);

/// Returns the width of a column of names: that of the widest one, at least `least`, at most
/// widest_column.
std::size_t column_width(std::span<const std::string> names, std::size_t least);

/// Returns as much of the text's beginning as fits into a width.
std::string_view cut_to(std::string_view text, std::size_t width);

} // namespace terrane::cli
