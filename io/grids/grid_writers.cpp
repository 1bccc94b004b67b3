// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grid_writers.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <terrane/algorithms/maps/grid_frame.hpp>
#include <terrane/io/grids/grid_text.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {

using namespace detail;

namespace {

/// The numbers that Irap and Surfer take for no value, and greater ones.
constexpr double irap_null = 9999900, surfer_null = 1.70141e38;

std::string text_of_number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

void append_line(std::string& out, std::initializer_list<double> numbers) {
    for (const double number : numbers) {
        if (!out.empty() && out.back() != '\n') out += ' ';
        append_number(out, number);
    }
    out += '\n';
}

/// Returns a number that is no value of the grid.
double unused_number(const Grid& grid) {
    double number = -9999;
    while (std::ranges::find(grid.values, number) != grid.values.end()) number = number * 10 - 9;
    return number;
}

/// Appends rows of values from the lowest y up, or down; a line has at most `most`.
void append_rows(std::string& out, const Grid& grid, const std::string& null, bool down,
                 std::size_t most) {
    for (std::size_t row = 0; row < grid.ny; ++row) {
        const std::size_t first = (down ? grid.ny - 1 - row : row) * grid.nx;
        for (std::size_t i = 0; i < grid.nx; ++i) {
            const double value = grid.values[first + i];
            out += std::isnan(value) ? null : text_of_number(value);
            out += i + 1 == grid.nx || (i + 1) % most == 0 ? '\n' : ' ';
        }
    }
}

/// Fails if a value is `limit` or more, which means that there is none.
MaybeError check_below(const Grid& grid, double limit, bool also_negative) {
    for (const double value : grid.values)
        if (value >= limit || (also_negative && value <= -limit))
            return Error{ErrorCode::bad_number,
                         "the format takes the value " + text_of_number(value) + " for none", ""};
    return std::nullopt;
}

double last_x(const Grid& grid) {
    return grid.x + (grid.nx - 1) * grid.dx;
}

double last_y(const Grid& grid) {
    return grid.y + (grid.ny - 1) * grid.dy;
}

} // namespace

Result<Grid> upright(const Grid& grid, bool may_turn) {
    if (grid.values.size() != std::size_t{grid.nx} * grid.ny || grid.values.empty() ||
        !(std::fabs(grid.dx) > 0) || !(std::fabs(grid.dy) > 0))
        return Error{ErrorCode::bad_option, "the grid has no steps or not nx ny values", ""};
    for (const double number : {grid.x, grid.y, grid.dx, grid.dy, grid.rotation})
        if (!std::isfinite(number))
            return Error{ErrorCode::bad_option, "a number of the grid is not finite", ""};
    for (const double value : grid.values)
        if (std::isinf(value)) return Error{ErrorCode::bad_number, "a value is infinite", ""};
    if (!may_turn && grid.rotation != 0)
        return Error{ErrorCode::unsupported,
                     "the grid is rotated, which of the formats .irap and .vti have", ""};
    Grid result = grid;
    const Point3 first =
        GridFrame(grid).node(grid.dx < 0 ? grid.nx - 1.0 : 0, grid.dy < 0 ? grid.ny - 1.0 : 0);
    result.x = first.x;
    result.y = first.y;
    result.dx = std::fabs(grid.dx);
    result.dy = std::fabs(grid.dy);
    for (std::size_t k = 0; k < grid.values.size(); ++k) {
        const std::size_t i = k % grid.nx, j = k / grid.nx;
        result.values[k] = grid.values[(grid.dy < 0 ? grid.ny - 1 - j : j) * grid.nx +
                                       (grid.dx < 0 ? grid.nx - 1 - i : i)];
    }
    return result;
}

Result<std::string> to_esri(const Grid& given) {
    const auto grid = upright(given, false);
    if (!grid) return grid.error();
    const std::string null = text_of_number(unused_number(*grid));
    std::string out = "ncols " + std::to_string(grid->nx) + "\nnrows " + std::to_string(grid->ny) +
                      "\nxllcenter " + text_of_number(grid->x) + "\nyllcenter " +
                      text_of_number(grid->y) + "\n";
    out += grid->dx == grid->dy
               ? "cellsize " + text_of_number(grid->dx)
               : "dx " + text_of_number(grid->dx) + "\ndy " + text_of_number(grid->dy);
    out += "\nNODATA_value " + null + "\n";
    append_rows(out, *grid, null, true, grid->nx);
    return out;
}

Result<std::string> to_zmap(const Grid& given) {
    const auto grid = upright(given, false);
    if (!grid) return grid.error();
    constexpr std::size_t in_line = 5, least_width = 15;
    const std::string null = text_of_number(unused_number(*grid));
    std::size_t width = std::max(least_width, null.size() + 1);
    for (const double value : grid->values)
        if (!std::isnan(value)) width = std::max(width, text_of_number(value).size() + 1);
    std::string name = replaced_texts(one_line(grid->name), ",", "_");
    std::string out = "! nodes column by column from the west, each from the north\n@" + name +
                      " HEADER, GRID, " + std::to_string(in_line) + "\n" + std::to_string(width) +
                      ", " + null + ", , 7, 1\n" + std::to_string(grid->ny) + ", " +
                      std::to_string(grid->nx);
    for (const double limit : {grid->x, last_x(*grid), grid->y, last_y(*grid)})
        out += ", " + text_of_number(limit);
    out += "\n0.0, 0.0, 0.0\n@\n";
    for (std::size_t i = 0; i < grid->nx; ++i)
        for (std::size_t row = 0; row < grid->ny; ++row) {
            const double value = grid->values[(grid->ny - 1 - row) * grid->nx + i];
            const std::string text = std::isnan(value) ? null : text_of_number(value);
            out += std::string(width - text.size(), ' ') + text;
            if (row + 1 == grid->ny || (row + 1) % in_line == 0) out += '\n';
        }
    return out;
}

Result<std::string> to_irap(const Grid& given) {
    const auto grid = upright(given);
    if (!grid) return grid.error();
    if (auto trouble = check_below(*grid, irap_null, false)) return *trouble;
    constexpr std::size_t in_line = 6;
    std::string out = "-996 " + std::to_string(grid->ny) + " ";
    out += text_of_number(grid->dx) + " " + text_of_number(grid->dy) + "\n";
    append_line(out, {grid->x, last_x(*grid), grid->y, last_y(*grid)});
    out += std::to_string(grid->nx) + " ";
    out += text_of_number(grid->rotation) + " " + text_of_number(grid->x) + " " +
           text_of_number(grid->y) + "\n0 0 0 0 0 0 0\n";
    append_rows(out, *grid, "9999900.000000", false, in_line);
    return out;
}

Result<std::string> to_surfer(const Grid& given) {
    const auto grid = upright(given, false);
    if (!grid) return grid.error();
    if (auto trouble = check_below(*grid, surfer_null, true)) return *trouble;
    double least = HUGE_VAL, largest = -HUGE_VAL;
    for (const double value : grid->values) {
        if (std::isnan(value)) continue;
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    if (least > largest) least = largest = 0; // there are no values
    std::string out = "DSAA\n" + std::to_string(grid->nx) + " " + std::to_string(grid->ny) + "\n";
    append_line(out, {grid->x, last_x(*grid)});
    append_line(out, {grid->y, last_y(*grid)});
    append_line(out, {least, largest});
    append_rows(out, *grid, "1.70141e+38", false, grid->nx);
    return out;
}

} // namespace terrane
