// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Columns of text, and the heading that names them.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::points::detail {

/// Splits a line at blanks, commas and semicolons, and removes quotes. At most 64 columns are
/// returned.
std::vector<std::string_view> columns_of(std::string_view line);

/// Splits a line at each `delimiter` outside of quotes, and removes blanks and quotes around cells.
std::vector<std::string_view> cells_of(std::string_view line, char delimiter);

/// The contents of a heading.
struct Heading {
    std::array<std::size_t, 3> xyz{};  ///< columns of x, y and z
    std::optional<std::size_t> name{}; ///< column with names of surfaces
    std::size_t columns = 0;           ///< how many it names
    char delimiter = ' ';              ///< ' ': blanks, commas and semicolons
    Role role = Role::unknown; ///< of the surfaces, as the column with their names is called
    CoordinateFrame frame{};   ///< units, and whether z is called depth
};

/// Reads a heading; none if it names no columns x, y and z.
std::optional<Heading> read_heading(std::string_view line);

} // namespace terrane::points::detail
