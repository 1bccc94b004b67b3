// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/zmap.hpp>

#include <array>

#include <fmt/format.h>

#include <terrane/io/grids/grid_text.hpp>

namespace terrane {

using namespace detail;

namespace {

class ZmapReader {
public:
    ZmapReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    MaybeError read(Grid& grid) {
        if (auto trouble = read_first_line(grid)) return trouble;
        if (auto trouble = read_fields()) return trouble;
        if (auto trouble = read_limits(grid)) return trouble;
        while (next_line() && !line_.starts_with('@')) continue; // these lines are not needed
        return read_heights(grid);
    }

private:
    /// Goes to the next line that is neither blank nor a comment.
    bool next_line() {
        while (in_.next()) {
            line_ = trimmed(in_.line());
            if (!line_.empty() && !line_.starts_with('!')) return true;
        }
        line_ = {};
        return false;
    }

    /// Returns the next part between commas, without the blanks around it.
    std::string_view next_part() {
        const auto comma = std::min(line_.find(','), line_.size());
        const auto part = trimmed(line_.substr(0, comma));
        line_.remove_prefix(std::min(comma + 1, line_.size()));
        return part;
    }

    /// Reads "@name HEADER, GRID, 5".
    MaybeError read_first_line(Grid& grid) {
        if (!next_line() || !line_.starts_with('@'))
            return in_.error(ErrorCode::bad_syntax, "expected a line that begins with @");
        line_.remove_prefix(1);
        auto title = next_part();
        if (const auto end = lower(title).rfind("header"); end != std::string::npos)
            title = trimmed(title.substr(0, end));
        if (!title.empty()) grid.name = title;
        if (const auto kind = next_part(); !same_ignoring_case(kind, "GRID"))
            return in_.error(ErrorCode::unsupported, shown(kind) + " is not read, only GRID");
        return std::nullopt;
    }

    /// Reads "15, -99999.0000, , 4, 1".
    MaybeError read_fields() {
        if (!next_line())
            return in_.error(ErrorCode::bad_syntax, "the line about fields is missing");
        std::int64_t width = 0;
        const auto token = next_part();
        if (!parse_integer(token, width) || width < 1 || width > 1000)
            return in_.error(ErrorCode::bad_syntax, shown(token) + " is no width of a field");
        width_ = static_cast<std::size_t>(width);
        const auto null = next_part();
        null_text_ = next_part();
        if (null.empty()) return std::nullopt;
        return in_.read_number(null, null_);
    }

    /// Reads "rows, columns, x0, x1, y0, y1".
    MaybeError read_limits(Grid& grid) {
        if (!next_line())
            return in_.error(ErrorCode::bad_syntax, "the line about rows and columns is missing");
        TokenStream text(in_, true);
        text.set_line(line_);
        if (auto trouble = text.count("the number of rows", grid.ny)) return trouble;
        if (auto trouble = text.count("the number of columns", grid.nx)) return trouble;
        std::array<double, 4> limits{};
        for (double& limit : limits) {
            const auto token = text.next_in_line();
            if (token.empty()) return in_.error(ErrorCode::bad_syntax, "limits are missing");
            if (auto trouble = in_.read_number(token, limit)) return trouble;
        }
        grid.x = limits[0];
        grid.y = limits[2];
        grid.dx = (limits[1] - limits[0]) / (grid.nx - 1.0);
        grid.dy = (limits[3] - limits[2]) / (grid.ny - 1.0);
        return check_steps(in_, grid);
    }

    MaybeError read_heights(Grid& grid) {
        if (auto trouble = make_room(TokenStream(in_), grid)) return trouble;
        std::size_t have = 0;
        while (next_line()) {
            if (line_.starts_with('+') && have == 0 && Tokens(line_).next() == "+") continue;
            if (auto trouble = read_line(grid, have)) return trouble;
        }
        if (have == grid.values.size()) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax, fmt::format("the file ends after {} of {} heights",
                                                            have, grid.values.size()));
    }

    MaybeError read_line(Grid& grid, std::size_t& have) {
        Tokens tokens(line_);
        for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
            if (token.size() <= width_) {
                if (auto trouble = add(token, grid, have)) return trouble;
                continue;
            }
            return read_line_in_fields(grid, have, have_of_line(token));
        }
        return std::nullopt;
    }

    /// Returns the number of heights on the current line before a token of it.
    std::size_t have_of_line(std::string_view token) const {
        Tokens tokens(line_);
        std::size_t before = 0;
        while (tokens.next().data() != token.data()) ++before;
        return before;
    }

    /// Reads the current line again from its first character on, by the width of the fields: its
    /// numbers touch.
    MaybeError read_line_in_fields(Grid& grid, std::size_t& have, std::size_t known) {
        have -= known;
        for (auto rest = in_.line(); !trimmed(rest).empty();) {
            const auto token = trimmed(rest.substr(0, width_));
            rest.remove_prefix(std::min(width_, rest.size()));
            if (auto trouble = add(token, grid, have)) return trouble;
        }
        return std::nullopt;
    }

    MaybeError add(std::string_view token, Grid& grid, std::size_t& have) {
        if (have == grid.values.size())
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("there are more than {} heights", grid.values.size()));
        double value = no_height;
        if (null_text_.empty() || token != null_text_)
            if (auto trouble = in_.read_number(token, value)) return trouble;
        const auto column = have / grid.ny, row = grid.ny - 1 - have % grid.ny;
        grid.values[row * grid.nx + column] = value == null_ ? no_height : value;
        ++have;
        return std::nullopt;
    }

    LineParser in_;
    std::string_view line_;
    std::size_t width_ = 0;
    double null_ = 1e30;
    std::string_view null_text_;
};

} // namespace

Result<Grid> read_zmap(std::string_view contents, std::string_view source, std::string_view name) {
    Grid grid;
    grid.name = name;
    if (auto trouble = ZmapReader(contents, source).read(grid)) return *trouble;
    return grid;
}

} // namespace terrane
