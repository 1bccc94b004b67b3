// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/detail/column_values.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane::points::detail {

using namespace terrane::detail;

ColumnValues::ColumnValues(const Heading& heading) {
    for (std::size_t i = 0; i < heading.names.size(); ++i) {
        if (std::ranges::count(heading.xyz, i) > 0 || heading.name == i) continue;
        ValueColumn& column = columns_.emplace_back();
        column.at = i;
        column.array.name = heading.names[i];
        column.array.unit = heading.units[i];
    }
}

void ColumnValues::add_text(std::string_view cell, ValueColumn& column) {
    ValueArray& array = column.array;
    const auto known = column.code_of.find(cell);
    auto code = static_cast<std::int64_t>(array.texts.size());
    if (known == column.code_of.end()) {
        array.texts.emplace_back(cell);
        column.code_of.emplace(cell, code);
    } else {
        code = known->second;
    }
    std::get<1>(array.numbers).push_back(code);
}

void ColumnValues::add(const std::vector<std::string_view>& cells) {
    for (ValueColumn& column : columns_) {
        if (column.is_mixed) continue;
        const auto cell = column.at < cells.size() ? cells[column.at] : std::string_view();
        double number = std::nan("");
        const bool is_text =
            !cell.empty() && parse_double(cell, number) == NumberState::not_a_number;
        if (is_text) number = std::nan("");
        if (!column.is_begun && is_text) { // empty cells before it are empty texts
            column.array.type = NumberType::int32;
            column.array.numbers = std::vector<std::int64_t>();
            for (std::size_t p = 0; p < points_; ++p) add_text("", column);
        }
        column.is_begun = column.is_begun || !cell.empty();
        if (column.array.is_integer())
            add_text(cell, column);
        else if (is_text)
            column.is_mixed = true;
        else
            std::get<0>(column.array.numbers).push_back(number);
    }
    ++points_;
}

void ColumnValues::end(Surface& surface) {
    for (ValueColumn& column : columns_) {
        const std::string name = column.array.name;
        if (points_ == 0 || column.is_mixed ||
            !add_array(std::move(column.array), surface.vertices.size(), surface.arrays))
            note_values(name, surface.values);
    }
}

} // namespace terrane::points::detail
