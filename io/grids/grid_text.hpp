// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tokens and checks that the readers of text grids share.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include <terrane/io/grids/grid.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

/// Iterates over the tokens of a text across the ends of lines; errors name the current line.
/// Tokens are separated by blanks, and by commas if `commas` is set.
class TokenStream {
public:
    TokenStream(LineParser& in, bool commas = false) : in_(in), commas_(commas) {}

    /// Returns the next token; empty at the end of the text.
    std::string_view next();
    /// Returns the next token of the current line; empty at its end.
    std::string_view next_in_line();
    /// Continues with the tokens of `line`.
    void set_line(std::string_view line) { rest_ = line; }

    /// Reads a number; `what` names it in errors.
    [[nodiscard]] MaybeError number(std::string_view what, double& value);
    [[nodiscard]] MaybeError integer(std::string_view what, std::int64_t& value);
    /// Reads the number of nodes along an axis, from 1 to 2^31.
    [[nodiscard]] MaybeError count(std::string_view what, std::uint32_t& value);

    [[nodiscard]] const LineParser& in() const { return in_; }
    /// Returns the number of unread bytes; at most half as many numbers can follow.
    [[nodiscard]] std::size_t bytes_left() const { return rest_.size() + in_.bytes_left(); }

private:
    [[nodiscard]] Error ends_before(std::string_view what) const;

    LineParser& in_;
    std::string_view rest_;
    bool commas_;
};

/// Sets all nx ny heights of the grid to no_height. Fails if the rest of the file is too short for
/// nx ny numbers.
[[nodiscard]] MaybeError make_room(const TokenStream& text, Grid& grid);

/// Fails if a step of the grid is 0 or not finite. The step along an axis with a single node, which
/// is NaN, becomes 1.
[[nodiscard]] MaybeError check_steps(const LineParser& in, Grid& grid);

/// Converts a grid to the only surface of a file.
Result<std::vector<Surface>> surfaces_of(const Result<Grid>& grid, std::string_view source,
                                         const ReadOptions& options);

} // namespace terrane::detail
