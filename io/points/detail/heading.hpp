// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Columns of text, and the heading that names them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
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
    std::vector<std::string> names{};  ///< of all columns, as spelled, without units; or none
    std::vector<std::string> units{};  ///< of all columns; empty: not stated
    char delimiter = ' ';              ///< ' ': blanks, commas and semicolons
    Role role = Role::unknown; ///< of the surfaces, as the column with their names is called
    CoordinateFrame frame{};   ///< units, and whether z is called depth
};

/// The columns of x, y and z that a caller states (ReadOptions::columns).
class StatedColumns {
public:
    StatedColumns() = default;
    explicit StatedColumns(std::string_view text);

    [[nodiscard]] bool are_stated() const { return !names_.empty(); }
    [[nodiscard]] bool are_numbers() const { return numbers_.has_value(); }
    [[nodiscard]] std::span<const std::string> names() const { return names_; }
    /// Returns a heading of the cells of a line of numbers; none if the stated cells are no numbers.
    [[nodiscard]] std::optional<Heading> heading_of_cells(std::string_view line) const;

private:
    std::vector<std::string> names_;                    ///< three, or none
    std::optional<std::array<std::size_t, 3>> numbers_; ///< from 0
};

/// Reads a heading; none if it does not name the columns x, y and z, or those that are stated.
std::optional<Heading> read_heading(std::string_view line, const StatedColumns& stated = {});

/// Returns the heading of columns with these names, between blanks; none as read_heading.
std::optional<Heading> heading_of(std::span<const std::string> names, const StatedColumns& stated);

/// Returns the names in a line that names columns, but not which are x, y and z: more than three,
/// as many as the first line of points has, between commas, semicolons or tabs, or with the name of
/// a coordinate among them. Nothing for any other line.
std::optional<std::string> unclear_columns(std::string_view line, std::string_view first_point);

/// What commas in a text mean.
enum class Commas { separate, decimal, unclear };

/// Finds out from lines with three numbers and more. Commas are decimal points where each number
/// has at most one, none has a point, and semicolons, tabs or blanks separate them. Between blanks
/// groups of three digits can be thousands as well, which is unclear.
Commas meaning_of_commas(std::string_view contents);

} // namespace terrane::points::detail
