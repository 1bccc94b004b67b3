// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/esri.hpp>

#include <map>

#include <fmt/format.h>

#include <terrane/io/grids/grid_text.hpp>

namespace terrane {

using namespace detail;

namespace {

class EsriReader {
public:
    EsriReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    MaybeError read(Grid& grid) {
        if (auto trouble = read_header()) return trouble;
        if (auto trouble = count("ncols", grid.nx)) return trouble;
        if (auto trouble = count("nrows", grid.ny)) return trouble;
        const double size = value_or("cellsize", 0);
        grid.dx = value_or("dx", size);
        grid.dy = value_or("dy", size);
        if (auto trouble = check_steps(in_, grid)) return trouble;
        if (auto trouble = place("x", grid.dx, grid.x)) return trouble;
        if (auto trouble = place("y", grid.dy, grid.y)) return trouble;
        return read_heights(grid);
    }

private:
    /// Reads lines of a keyword and a number up to a line that begins with a number.
    MaybeError read_header() {
        while (in_.next()) {
            Tokens tokens(in_.line());
            const auto keyword = tokens.next();
            double value = 0;
            if (keyword.empty()) continue;
            if (parse_double(keyword, value) == NumberState::ok) return std::nullopt;
            if (auto trouble = in_.read_number(tokens.next(), value)) return trouble;
            header_[lower(keyword)] = value;
        }
        return in_.error(ErrorCode::bad_syntax, "the file ends before the heights");
    }

    [[nodiscard]] double value_or(const char* keyword, double otherwise) const {
        const auto found = header_.find(keyword);
        return found == header_.end() ? otherwise : found->second;
    }

    MaybeError count(const char* keyword, std::uint32_t& result) const {
        const double value = value_or(keyword, 0);
        result = value >= 1 && value < 2147483648.0 ? static_cast<std::uint32_t>(value) : 0;
        if (result == 0 || static_cast<double>(result) != value)
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} is missing or no number of cells", keyword));
        return std::nullopt;
    }

    MaybeError place(const std::string& axis, double step, double& result) const {
        const auto corner = header_.find(axis + "llcorner");
        const auto centre = header_.find(axis + "llcenter");
        if (centre != header_.end()) {
            result = centre->second;
        } else if (corner != header_.end()) {
            result = corner->second + step / 2;
        } else {
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{0}llcorner or {0}llcenter is missing", axis));
        }
        return std::nullopt;
    }

    MaybeError read_heights(Grid& grid) {
        const double null = value_or("nodata_value", -9999);
        TokenStream text(in_);
        text.set_line(in_.line());
        if (auto trouble = make_room(text, grid)) return trouble;
        for (std::size_t row = grid.ny; row-- > 0;)
            for (std::size_t column = 0; column < grid.nx; ++column) {
                double value = 0;
                if (auto trouble = text.number("the last height", value)) return trouble;
                grid.values[row * grid.nx + column] = value == null ? no_height : value;
            }
        if (text.next().empty()) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("there are more than {} x {} heights", grid.nx, grid.ny));
    }

    LineParser in_;
    std::map<std::string, double> header_; ///< values by keyword, in lower case
};

} // namespace

Result<Grid> read_esri(std::string_view contents, std::string_view source, std::string_view name) {
    Grid grid;
    grid.name = name;
    if (auto trouble = EsriReader(contents, source).read(grid)) return *trouble;
    return grid;
}

} // namespace terrane
