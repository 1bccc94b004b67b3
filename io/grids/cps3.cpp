// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/cps3.hpp>

#include <array>
#include <cmath>

#include <fmt/format.h>

#include <terrane/io/grids/grid_text.hpp>

namespace terrane {

using namespace detail;

namespace {

class Cps3Reader {
public:
    Cps3Reader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    MaybeError read(Grid& grid) {
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty() || line.starts_with('!')) continue;
            bool header = false;
            if (auto trouble = read_header(line, grid, header)) return trouble;
            if (!header) break;
        }
        if (!has_limits_ || grid.nx == 0)
            return in_.error(ErrorCode::bad_syntax,
                             "a CPS-3 grid needs FSLIMI and FSNROW before its heights");
        grid.x = limits_[0];
        grid.y = limits_[2];
        grid.dx = (limits_[1] - limits_[0]) / (grid.nx - 1.0);
        grid.dy = (limits_[3] - limits_[2]) / (grid.ny - 1.0);
        if (auto trouble = check_steps(in_, grid)) return trouble;
        return read_heights(grid);
    }

private:
    MaybeError read_header(std::string_view line, Grid& grid, bool& header) {
        Tokens tokens(line);
        const auto keyword = tokens.next();
        header = true;
        if (keyword == "FSASCI") return read_null(tokens);
        if (keyword == "FSNROW") {
            TokenStream text(in_);
            text.set_line(tokens.rest());
            if (auto trouble = text.count("the number of rows", grid.ny)) return trouble;
            return text.count("the number of columns", grid.nx);
        }
        if (keyword == "FSLIMI") {
            has_limits_ = true;
            for (double& limit : limits_)
                if (auto trouble = in_.read_number(tokens.next(), limit)) return trouble;
            return std::nullopt;
        }
        if (line.starts_with("->")) {
            if (const auto title = trimmed(line.substr(2)); !title.empty()) grid.name = title;
            return std::nullopt;
        }
        header = keyword.starts_with("FS");
        return std::nullopt;
    }

    /// Reads the value for no height: the number of the largest size on the line
    /// "FSASCI 0 1 COMPUTED 0 0.1E+31".
    MaybeError read_null(Tokens tokens) {
        double found = 0;
        for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
            double value = 0;
            if (parse_double(token, value) == NumberState::ok && std::abs(value) > std::abs(found))
                found = value;
        }
        if (std::abs(found) > 1) null_ = found;
        return std::nullopt;
    }

    [[nodiscard]] bool is_null(double value) const {
        return null_ > 0 ? value >= null_ * (1 - 1e-6) : value <= null_ * (1 - 1e-6);
    }

    MaybeError read_heights(Grid& grid) {
        TokenStream text(in_);
        text.set_line(in_.line());
        if (auto trouble = make_room(text, grid)) return trouble;
        for (std::size_t column = 0; column < grid.nx; ++column)
            for (std::size_t row = grid.ny; row-- > 0;) {
                double value = 0;
                if (auto trouble = text.number("the last height", value)) return trouble;
                grid.values[row * grid.nx + column] = is_null(value) ? no_height : value;
            }
        if (text.next().empty()) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("there are more than {} x {} heights", grid.nx, grid.ny));
    }

    LineParser in_;
    std::array<double, 4> limits_{};
    bool has_limits_ = false;
    double null_ = 1e30;
};

} // namespace

Result<Grid> read_cps3(std::string_view contents, std::string_view source, std::string_view name) {
    Grid grid;
    grid.name = name;
    if (auto trouble = Cps3Reader(contents, source).read(grid)) return *trouble;
    return grid;
}

} // namespace terrane
