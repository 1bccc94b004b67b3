// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What readers of grids in text have in common. Private to io.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include <terrane/io/grids/grid.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

/// Tokens of a text over the ends of lines, with the line of the current one for errors.
/// Separators: blanks and commas, if `commas`.
class TokenStream {
public:
    TokenStream(LineParser& in, bool commas = false) : in_(in), commas_(commas) {}

    /// The next token; empty at the end.
    std::string_view next();
    /// The same, of the current line only.
    std::string_view next_in_line();
    /// What is left of the current line is not read.
    void skip_line() { rest_ = {}; }
    /// Goes on with the tokens of this line.
    void set_line(std::string_view line) { rest_ = line; }

    /// A number; `what` names it in errors.
    [[nodiscard]] MaybeError number(std::string_view what, double& value);
    [[nodiscard]] MaybeError integer(std::string_view what, std::int64_t& value);
    /// How many nodes there are along an axis: from 1 to 2^31.
    [[nodiscard]] MaybeError count(std::string_view what, std::uint32_t& value);

    [[nodiscard]] const LineParser& in() const { return in_; }
    /// Bytes that are still to be read: no more numbers than half of them can follow.
    [[nodiscard]] std::size_t bytes_left() const { return rest_.size() + in_.bytes_left(); }

private:
    [[nodiscard]] Error ends_before(std::string_view what) const;

    LineParser& in_;
    std::string_view rest_;
    bool commas_;
};

/// Makes room for nx ny heights, none of which is there yet; an error where the file is too short
/// for so many numbers.
[[nodiscard]] MaybeError make_room(const TokenStream& text, Grid& grid);

/// A step, or the distance between `count` nodes from low to high; an error where it is 0.
[[nodiscard]] MaybeError check_steps(const LineParser& in, Grid& grid);

/// The surface of a grid as the one surface of a file.
Result<std::vector<Surface>> surfaces_of(const Result<Grid>& grid, std::string_view source,
                                         const ReadOptions& options);

} // namespace terrane::detail
