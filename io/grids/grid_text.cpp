// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grid_text.hpp>

#include <cmath>

#include <fmt/format.h>

namespace terrane::detail {

std::string_view TokenStream::next_in_line() {
    const auto separates = [&](char c) { return is_blank(c) || (commas_ && c == ','); };
    std::size_t begin = 0;
    while (begin < rest_.size() && separates(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !separates(rest_[end])) ++end;
    const auto token = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return token;
}

std::string_view TokenStream::next() {
    auto token = next_in_line();
    while (token.empty() && in_.next()) {
        rest_ = in_.line();
        token = next_in_line();
    }
    return token;
}

Error TokenStream::ends_before(std::string_view what) const {
    auto sentence = fmt::format("the file ends before {}", what);
    return in_.number() == 0 ? in_.file_error(ErrorCode::bad_syntax, std::move(sentence))
                             : in_.error(ErrorCode::bad_syntax, std::move(sentence));
}

MaybeError TokenStream::number(std::string_view what, double& value) {
    const auto token = next();
    if (token.empty()) return ends_before(what);
    return in_.read_number(token, value);
}

MaybeError TokenStream::integer(std::string_view what, std::int64_t& value) {
    const auto token = next();
    if (token.empty()) return ends_before(what);
    if (parse_integer(token, value)) return std::nullopt;
    return in_.error(ErrorCode::bad_syntax, fmt::format("{} is not {}", shown(token), what));
}

MaybeError TokenStream::count(std::string_view what, std::uint32_t& value) {
    std::int64_t wide = 0;
    if (auto trouble = integer(what, wide)) return trouble;
    if (wide < 1 || wide > (std::int64_t{1} << 31))
        return in_.error(ErrorCode::bad_syntax, fmt::format("{} is not {}", wide, what));
    value = static_cast<std::uint32_t>(wide);
    return std::nullopt;
}

MaybeError make_room(const TokenStream& text, Grid& grid) {
    const std::uint64_t nodes = std::uint64_t{grid.nx} * grid.ny;
    if (nodes > text.bytes_left() / 2 + 1)
        return text.in().error(
            ErrorCode::bad_syntax,
            fmt::format("the file is too short for {} x {} heights", grid.nx, grid.ny));
    grid.values.assign(nodes, no_height);
    return std::nullopt;
}

MaybeError check_steps(const LineParser& in, Grid& grid) {
    for (double* step : {&grid.dx, &grid.dy}) {
        if (std::isnan(*step)) *step = 1; // there is one node only, hence no distance
        if (*step == 0 || !std::isfinite(*step))
            return in.error(ErrorCode::bad_number, "the nodes of the grid coincide");
    }
    return std::nullopt;
}

Result<std::vector<Surface>> surfaces_of(const Result<Grid>& grid, std::string_view source,
                                         const ReadOptions& options) {
    if (!grid) return grid.error();
    auto surface = surface_of_grid(grid.value(), options.depth);
    if (!surface) {
        Error error = surface.error();
        error.place = source;
        return error;
    }
    std::vector<Surface> surfaces;
    surfaces.push_back(std::move(surface).value());
    return surfaces;
}

} // namespace terrane::detail
