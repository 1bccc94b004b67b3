// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Columns of points besides their coordinates and the name of their surface.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/io/points/detail/heading.hpp>

namespace terrane::points::detail {

/// The further columns of the points of one surface. A column is of texts if its first cell that is not empty is no
/// number. One with texts after numbers is not read.
class ColumnValues {
public:
    ColumnValues() = default;
    explicit ColumnValues(const Heading& heading);

    /// Takes the cells of a point.
    void add(const std::vector<std::string_view>& cells);
    /// Gives the surface of these points the arrays, and the names of columns that are not read.
    void end(Surface& surface);

private:
    struct ValueColumn {
        std::size_t at = 0; ///< among the cells
        ValueArray array{};
        bool is_begun = false; ///< it is known whether the cells are texts
        bool is_mixed = false;
        std::map<std::string, std::int64_t, std::less<>> code_of{};
    };
    static void add_text(std::string_view cell, ValueColumn& column);

    std::vector<ValueColumn> columns_;
    std::size_t points_ = 0;
};

} // namespace terrane::points::detail
