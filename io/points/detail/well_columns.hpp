// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The columns of a table of wells, or the curves of a LAS file, and the paths that their rows make.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/io/points/well_paths.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::points::detail {

/// The meanings of columns.
enum class WellColumn : std::uint8_t { well, depth, x, y, z, inclination, azimuth };

/// Finds columns by their names.
class WellColumns {
public:
    /// Takes the name of the next column, as "md" or "z (m)". `unit`: what is stated apart from the name.
    void add(std::string_view name, std::string_view unit = "");

    /// Returns the number of a column, if it is there.
    [[nodiscard]] std::optional<std::size_t> at(WellColumn column) const {
        return found_[static_cast<std::size_t>(column)];
    }
    [[nodiscard]] bool have_positions() const {
        return at(WellColumn::x) && at(WellColumn::y) && at(WellColumn::z);
    }
    [[nodiscard]] bool have_survey() const {
        return at(WellColumn::depth) && at(WellColumn::inclination) && at(WellColumn::azimuth);
    }
    /// Returns the columns with numbers that a path is made of: x, y, z and perhaps depth, or depth, inclination, azimuth.
    [[nodiscard]] std::vector<std::size_t> wanted() const;
    [[nodiscard]] std::size_t count() const { return count_; }
    /// Returns the unit of lengths; nothing if two differ.
    [[nodiscard]] std::optional<std::string> unit() const;

private:
    std::array<std::optional<std::size_t>, 7> found_{};
    std::vector<std::string> units_; ///< that are stated, of lengths
    std::size_t count_ = 0;
    bool has_plain_depth_ =
        false; ///< whether the depth is called so, which may be another depth than the measured one
};

/// Rows of a well, of the columns that are wanted.
struct WellRows {
    std::string name;
    std::vector<std::array<double, 4>> rows;
};

/// Makes the path of a well. Errors: bad_option at the source.
Result<WellPath> path_of(const WellRows& well, const WellColumns& columns,
                         std::span<const WellHead> heads, std::string_view source);

/// Reads the rows of a LAS file; adds a head if the file has one. Errors: those of read_well_paths().
Result<WellRows> read_las(std::string_view contents, std::string_view source, std::string_view name,
                          WellColumns& columns, std::vector<WellHead>& heads);

} // namespace terrane::points::detail
