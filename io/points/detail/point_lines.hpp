// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions that the readers of points in lines of text share.
#pragma once

#include <cmath>
#include <string_view>

#include <terrane/io/text/text.hpp>

namespace terrane::points::detail {

/// Tells whether a z stands for no height.
inline bool is_no_height(double z) {
    return std::abs(z) >= 1e29 || z == -99999 || z == -9999 || z == -999.25;
}

inline bool is_number(std::string_view token) {
    double value = 0;
    return terrane::detail::parse_double(token, value) !=
           terrane::detail::NumberState::not_a_number;
}

/// Tells whether a line is a comment; the line has no blanks around it.
inline bool is_comment(std::string_view line) {
    return line.starts_with('#') || line.starts_with('!') || line.starts_with('@') ||
           line.starts_with("//");
}

/// Tells whether a line ends the points.
inline bool ends_points(std::string_view line) {
    return line == "EOD" || line == "EOB";
}

} // namespace terrane::points::detail
