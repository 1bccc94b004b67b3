// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/surfer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include <terrane/io/grids/grid_text.hpp>
#include <terrane/io/text/bytes.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr double least_blank = 1.70141e38;

double height_of(double value, double blank = least_blank) {
    return std::fabs(value) >= least_blank || value == blank || std::isnan(value) ? no_height
                                                                                  : value;
}

/// Sets the steps from the first node to the last ones; both are part of the grid.
void span_grid(Grid& grid, double last_x, double last_y) {
    grid.dx = grid.nx > 1 ? (last_x - grid.x) / (grid.nx - 1) : 1;
    grid.dy = grid.ny > 1 ? (last_y - grid.y) / (grid.ny - 1) : 1;
}

MaybeError read_surfer_text(LineParser& in, Grid& grid) {
    in.next(); // DSAA
    TokenStream text(in);
    double nx = 0, ny = 0, last_x = 0, last_y = 0, least = 0, largest = 0;
    for (double* number : {&nx, &ny, &grid.x, &last_x, &grid.y, &last_y, &least, &largest})
        if (auto trouble = text.number("the header", *number)) return trouble;
    const auto is_count = [](double n) { return n >= 1 && n < 2147483648.0 && n == std::floor(n); };
    if (!is_count(nx) || !is_count(ny))
        return in.error(ErrorCode::bad_syntax,
                        "the second line needs the numbers of columns and rows, from 1 on");
    grid.nx = static_cast<std::uint32_t>(nx);
    grid.ny = static_cast<std::uint32_t>(ny);
    span_grid(grid, last_x, last_y);
    if (auto trouble = check_steps(in, grid)) return trouble;
    if (auto trouble = make_room(text, grid)) return trouble;
    for (double& height : grid.values) {
        if (auto trouble = text.number("the last height", height)) return trouble;
        height = height_of(height);
    }
    if (text.next().empty()) return std::nullopt;
    return in.error(ErrorCode::bad_syntax,
                    fmt::format("there are more than {} x {} heights", grid.nx, grid.ny));
}

/// Reads numbers of a binary grid one after the other.
class SurferBinary {
public:
    SurferBinary(std::string_view contents, std::string_view source) :
        contents_(contents), source_(source) {}

    template <class T>
    T next() {
        if (left() < sizeof(T)) {
            is_short_ = true;
            return {};
        }
        at_ += sizeof(T);
        return load<T>(contents_.data() + at_ - sizeof(T));
    }

    MaybeError read_version_6(Grid& grid) {
        at_ = 4; // DSBB
        grid.nx = next<std::uint16_t>();
        grid.ny = next<std::uint16_t>();
        grid.x = next<double>();
        const double last_x = next<double>();
        grid.y = next<double>();
        const double last_y = next<double>();
        at_ += 2 * sizeof(double); // the least and the largest height
        span_grid(grid, last_x, last_y);
        return read_heights<float>(grid, least_blank);
    }

    MaybeError read_version_7(Grid& grid) {
        double blank = least_blank;
        bool has_grid = false;
        while (at_ < contents_.size() && !is_short_) {
            const auto tag = next<std::uint32_t>();
            const auto size = next<std::uint32_t>();
            const std::size_t begin = at_;
            if (tag == 0x44495247) { // GRID
                grid.ny = next<std::uint32_t>();
                grid.nx = next<std::uint32_t>();
                for (double* number : {&grid.x, &grid.y, &grid.dx, &grid.dy})
                    *number = next<double>();
                at_ +=
                    3 *
                    sizeof(double); // the least and the largest height, a rotation that is not used
                blank = next<double>();
                has_grid = true;
            } else if (tag == 0x41544144 && has_grid) { // DATA
                return read_heights<double>(grid, blank);
            }
            if (size > contents_.size() - begin) break;
            at_ = begin + size;
        }
        return error(ErrorCode::bad_syntax, "the sections GRID and DATA are not there");
    }

private:
    /// The number of bytes that were not passed over.
    [[nodiscard]] std::size_t left() const {
        return contents_.size() - std::min(at_, contents_.size());
    }

    template <class T>
    MaybeError read_heights(Grid& grid, double blank) {
        const std::uint64_t count = std::uint64_t{grid.nx} * grid.ny;
        if (is_short_ || count == 0 || count > left() / sizeof(T))
            return error(
                ErrorCode::bad_syntax,
                fmt::format("the file is too short for {} x {} heights", grid.nx, grid.ny));
        if (!(std::isfinite(grid.dx) && std::isfinite(grid.dy) && grid.dx != 0 && grid.dy != 0))
            return error(ErrorCode::bad_number, "a step of the grid is 0 or not finite");
        grid.values.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i)
            grid.values.push_back(height_of(static_cast<double>(next<T>()), blank));
        return std::nullopt;
    }

    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return {code, std::move(sentence), fmt::format("{}, byte {}", source_, at_)};
    }

    std::string_view contents_, source_;
    std::size_t at_ = 0;
    bool is_short_ = false;
};

} // namespace

Result<Grid> read_surfer(std::string_view contents, std::string_view source,
                         std::string_view name) {
    Grid grid;
    grid.name = name;
    LineParser in(contents, source);
    MaybeError trouble;
    if (contents.starts_with("DSAA"))
        trouble = read_surfer_text(in, grid);
    else if (contents.starts_with("DSBB"))
        trouble = SurferBinary(contents, source).read_version_6(grid);
    else if (contents.starts_with("DSRB"))
        trouble = SurferBinary(contents, source).read_version_7(grid);
    else
        trouble =
            in.file_error(ErrorCode::unsupported,
                          "this is no grid of Surfer (DSAA, DSBB or DSRB); a NetCDF grid of GMT "
                          "is read as text: gmt grd2xyz FILE > points.xyz");
    if (trouble) return *trouble;
    return grid;
}

} // namespace terrane
