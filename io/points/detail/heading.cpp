// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/detail/heading.hpp>

#include <initializer_list>
#include <string>
#include <utility>

#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane::points::detail {

using namespace terrane::detail;

namespace {

constexpr std::size_t most_columns = 64;

/// A column called "Depth (ft)" has the name "depth" and the unit "ft".
struct Column {
    std::string name; ///< in small letters
    std::string unit; ///< empty: none
};

/// Returns the unit in "(m)" or "[ft]"; empty if there is none.
std::string unit_in_brackets(std::string_view text) {
    text = trimmed(text);
    if (text.size() < 3 || (text.front() != '(' && text.front() != '[')) return {};
    if (text.back() != (text.front() == '(' ? ')' : ']')) return {};
    auto unit = unit_named(text.substr(1, text.size() - 2));
    return metres_in(unit) ? unit : std::string();
}

Column column_called(std::string_view text) {
    text = trimmed(text);
    if (const auto bracket = text.find_first_of("(["); bracket != std::string_view::npos)
        if (auto unit = unit_in_brackets(text.substr(bracket)); !unit.empty())
            return {lower(trimmed(text.substr(0, bracket))), std::move(unit)};
    if (const auto end = text.rfind('_'); end != std::string_view::npos && end > 0) {
        auto unit = unit_named(text.substr(end + 1));
        if (metres_in(unit)) return {lower(text.substr(0, end)), std::move(unit)};
    }
    return {lower(text), {}};
}

char delimiter_of(std::string_view line) {
    for (const char delimiter : {';', '\t', ','})
        if (line.find(delimiter) != std::string_view::npos) return delimiter;
    return ' ';
}

/// Returns the columns of a heading; a bracketed unit between blanks belongs to the column before
/// it.
std::vector<Column> named_columns(std::string_view line, char delimiter) {
    const auto texts = delimiter == ' ' ? columns_of(line) : cells_of(line, delimiter);
    std::vector<Column> columns;
    for (const auto text : texts) {
        auto unit = unit_in_brackets(text);
        if (!unit.empty() && !columns.empty() && columns.back().unit.empty())
            columns.back().unit = std::move(unit);
        else
            columns.push_back(column_called(text));
    }
    return columns;
}

/// Returns the index of the first of the wanted names that a column has, if any.
std::optional<std::size_t> place_of(const std::vector<Column>& columns,
                                    std::initializer_list<std::string_view> wanted) {
    for (const auto name : wanted)
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (columns[i].name == name) return i;
    return std::nullopt;
}

Role role_named(std::string_view column) {
    if (column == "fault") return Role::fault;
    return column == "horizon" ? Role::horizon : Role::unknown;
}

} // namespace

std::vector<std::string_view> columns_of(std::string_view line) {
    const auto separates = [](char c) { return is_blank(c) || c == ',' || c == ';'; };
    std::vector<std::string_view> columns;
    std::size_t i = 0;
    while (i < line.size() && columns.size() < most_columns) {
        if (separates(line[i])) {
            ++i;
            continue;
        }
        const bool quoted = line[i] == '"';
        const auto begin = quoted ? i + 1 : i;
        auto end = begin;
        while (end < line.size() && (quoted ? line[end] != '"' : !separates(line[end]))) ++end;
        columns.push_back(line.substr(begin, end - begin));
        i = quoted ? end + 1 : end;
    }
    return columns;
}

std::vector<std::string_view> cells_of(std::string_view line, char delimiter) {
    std::vector<std::string_view> cells;
    std::size_t begin = 0;
    bool quoted = false;
    for (std::size_t i = 0; i <= line.size() && cells.size() < most_columns; ++i) {
        if (i < line.size() && line[i] == '"') quoted = !quoted;
        if (i < line.size() && (quoted || line[i] != delimiter)) continue;
        auto cell = trimmed(line.substr(begin, i - begin));
        if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        cells.push_back(cell);
        begin = i + 1;
    }
    return cells;
}

std::optional<Heading> read_heading(std::string_view line) {
    Heading heading;
    heading.delimiter = delimiter_of(line);
    const auto columns = named_columns(line, heading.delimiter);
    const auto x = place_of(columns, {"x", "easting", "x_coord", "inline"});
    const auto y = place_of(columns, {"y", "northing", "y_coord", "crossline", "xline"});
    const auto z = place_of(columns, {"z", "elevation", "depth", "tvdss", "z_coord"});
    if (!x || !y || !z) return std::nullopt;
    heading.xyz = {*x, *y, *z};
    heading.columns = columns.size();
    heading.name = place_of(columns, {"surface", "formation", "horizon", "fault", "unit", "name"});
    if (heading.name) heading.role = role_named(columns[*heading.name].name);
    if (columns[*x].unit == columns[*y].unit) heading.frame.horizontal_unit = columns[*x].unit;
    heading.frame.vertical_unit = columns[*z].unit;
    const auto& called = columns[*z].name;
    heading.frame.column_of_depths = called == "depth" || called == "tvdss";
    return heading;
}

} // namespace terrane::points::detail
