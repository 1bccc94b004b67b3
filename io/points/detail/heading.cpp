// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/detail/heading.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include <terrane/io/points/detail/point_lines.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane::points::detail {

using namespace terrane::detail;

namespace {

constexpr std::size_t most_columns = 64;

/// A column called "Depth (ft)" has the name "depth" and the unit "ft".
struct Column {
    std::string name;      ///< in small letters
    std::string unit;      ///< empty: none
    std::string spelled{}; ///< the name as in the heading
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
            return {lower(trimmed(text.substr(0, bracket))), std::move(unit),
                    std::string(trimmed(text.substr(0, bracket)))};
    if (const auto end = text.rfind('_'); end != std::string_view::npos && end > 0) {
        auto unit = unit_named(text.substr(end + 1));
        if (metres_in(unit))
            return {lower(text.substr(0, end)), std::move(unit), std::string(text.substr(0, end))};
    }
    return {lower(text), {}, std::string(text)};
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
                                    std::span<const std::string_view> wanted) {
    for (const auto name : wanted)
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (columns[i].name == name) return i;
    return std::nullopt;
}

/// The names of columns with coordinates, the likeliest first.
constexpr std::array<std::string_view, 12> names_of_x{"x",         "easting", "x_coord", "xcoord",
                                                      "x_utm",     "utm_x",   "utmx",    "east",
                                                      "x_easting", "inline",  "iline",   "il"};
constexpr std::array<std::string_view, 14> names_of_y{
    "y",     "northing",   "y_coord",   "ycoord", "y_utm", "utm_y", "utmy",
    "north", "y_northing", "crossline", "xline",  "cline", "xl",    "cl"};
constexpr std::array<std::string_view, 14> names_of_z{
    "z",  "elevation", "elev",  "z_coord", "zcoord",  "height", "altitude",
    "rl", "depth",     "tvdss", "tvd",     "z_value", "zvalue", "z_depth"};

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

namespace {

std::optional<Heading> heading_of(const std::vector<Column>& columns, char delimiter,
                                  const StatedColumns& stated) {
    Heading heading;
    heading.delimiter = delimiter;
    const auto place = [&](std::size_t i, std::span<const std::string_view> usual) {
        if (!stated.are_stated()) return place_of(columns, usual);
        const std::string name = column_called(stated.names()[i]).name;
        return place_of(columns, std::array{std::string_view(name)});
    };
    const auto x = place(0, names_of_x), y = place(1, names_of_y), z = place(2, names_of_z);
    if (!x || !y || !z) return std::nullopt;
    heading.xyz = {*x, *y, *z};
    heading.columns = columns.size();
    for (const Column& column : columns) {
        heading.names.push_back(column.spelled);
        heading.units.push_back(column.unit);
    }
    constexpr std::array<std::string_view, 6> surfaces{"surface", "formation", "horizon",
                                                       "fault",   "unit",      "name"};
    heading.name = place_of(columns, surfaces);
    if (heading.name) heading.role = role_named(columns[*heading.name].name);
    if (columns[*x].unit == columns[*y].unit) heading.frame.horizontal_unit = columns[*x].unit;
    heading.frame.vertical_unit = columns[*z].unit;
    const auto& called = columns[*z].name;
    heading.frame.column_of_depths = called == "depth" || called == "tvdss" || called == "tvd";
    return heading;
}

/// Tells whether a text is an integer with a comma inside: "-1000,25". Sets whether three digits
/// follow the comma and at most three come before.
bool has_decimal_comma(std::string_view token, bool& like_thousands) {
    if (token.starts_with('-') || token.starts_with('+')) token.remove_prefix(1);
    const auto comma = token.find(',');
    if (comma == std::string_view::npos || comma == 0) return false;
    auto after = token.substr(comma + 1);
    if (const auto e = after.find_first_of("eE"); e != std::string_view::npos)
        after = after.substr(0, e);
    const auto is_digits = [](std::string_view text) {
        return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
    };
    if (!is_digits(token.substr(0, comma)) || !is_digits(after)) return false;
    like_thousands = like_thousands && after.size() == 3 && comma <= 3;
    return true;
}

} // namespace

StatedColumns::StatedColumns(std::string_view text) {
    if (text.empty()) return;
    for (const auto name : cells_of(text, ',')) names_.emplace_back(name);
    names_.resize(3); // check_reading() has refused others
    std::array<std::size_t, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
        std::int64_t number = 0;
        if (!parse_integer(names_[i], number) || number < 1 ||
            number > static_cast<std::int64_t>(most_columns))
            return;
        numbers[i] = static_cast<std::size_t>(number) - 1;
    }
    numbers_ = numbers;
}

std::optional<Heading> StatedColumns::heading_of_cells(std::string_view line) const {
    Heading heading;
    heading.delimiter = delimiter_of(line);
    const auto cells =
        heading.delimiter == ' ' ? columns_of(line) : cells_of(line, heading.delimiter);
    heading.xyz = *numbers_;
    heading.columns = cells.size();
    const auto has_number = [&](std::size_t i) { return i < cells.size() && is_number(cells[i]); };
    if (!std::ranges::all_of(heading.xyz, has_number)) return std::nullopt;
    return heading;
}

std::optional<Heading> read_heading(std::string_view line, const StatedColumns& stated) {
    const char delimiter = delimiter_of(line);
    return heading_of(named_columns(line, delimiter), delimiter, stated);
}

std::optional<Heading> heading_of(std::span<const std::string> names, const StatedColumns& stated) {
    std::vector<Column> columns;
    for (const std::string& name : names) columns.push_back(column_called(name));
    return heading_of(columns, ' ', stated);
}

std::optional<std::string> unclear_columns(std::string_view line, std::string_view first_point) {
    const char delimiter = delimiter_of(line);
    const auto columns = named_columns(line, delimiter);
    const auto count =
        delimiter == ' ' ? columns_of(first_point).size() : cells_of(first_point, delimiter).size();
    if (columns.size() < 4 || columns.size() != count) return std::nullopt;
    if (delimiter == ' ' && !place_of(columns, names_of_x) && !place_of(columns, names_of_y) &&
        !place_of(columns, names_of_z))
        return std::nullopt;
    std::string text;
    for (const Column& column : columns) text += (text.empty() ? "" : ", ") + column.name;
    return text;
}

Commas meaning_of_commas(std::string_view contents) {
    constexpr std::size_t most_lines = 1000;
    std::size_t decimal = 0;
    bool like_thousands = true, blanks = true;
    for (std::size_t lines = 0; !contents.empty() && lines < most_lines; ++lines) {
        const auto end = std::min(contents.find('\n'), contents.size());
        const auto line = trimmed(contents.substr(0, end));
        contents.remove_prefix(std::min(end + 1, contents.size()));
        if (is_comment(line)) continue;
        const char delimiter = line.find(';') != std::string_view::npos    ? ';'
                               : line.find('\t') != std::string_view::npos ? '\t'
                                                                           : ' ';
        std::size_t numbers = 0, with_comma = 0;
        for (std::string_view token : cells_of(line, delimiter)) {
            if (token.empty()) continue;
            if (has_decimal_comma(token, like_thousands))
                ++with_comma;
            else if (!is_number(token))
                continue;
            else if (token.find('.') != std::string_view::npos)
                return Commas::separate;
            ++numbers;
        }
        if (numbers < 3 || with_comma == 0) continue;
        ++decimal;
        blanks = blanks && delimiter == ' ';
    }
    if (decimal == 0) return Commas::separate;
    return blanks && like_thousands ? Commas::unclear : Commas::decimal;
}

} // namespace terrane::points::detail
