// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lines, tokens and numbers of text formats. They are views into one buffer; the locale has no
// influence, and memory is allocated only to report an error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::detail {

/// The error of a step that returns no value; empty after success.
using MaybeError = std::optional<Error>;

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower(std::string_view text);
[[nodiscard]] bool same_ignoring_case(std::string_view a, std::string_view b);

/// Returns a text with each `from` in it replaced.
[[nodiscard]] std::string replaced_texts(std::string_view text, std::string_view from,
                                         std::string_view to);

/// Returns a text as a cell of CSV: in double quotes if it has a comma, a quote or a line end.
[[nodiscard]] std::string csv_cell(std::string_view text);

/// Quotes a token for a message: at most 40 characters of it, with '?' for unprintable ones.
[[nodiscard]] std::string shown(std::string_view token);

/// Splits a line at blanks.
class Tokens {
public:
    explicit Tokens(std::string_view line) : rest_(line) {}

    /// Returns the next token; empty at the end of the line.
    std::string_view next() {
        std::size_t begin = 0;
        while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
        std::size_t end = begin;
        while (end < rest_.size() && !is_blank(rest_[end])) ++end;
        const auto token = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        return token;
    }

    /// Returns the rest of the line without blanks at its ends.
    [[nodiscard]] std::string_view rest() const { return trimmed(rest_); }

private:
    std::string_view rest_;
};

enum class NumberState {
    ok,
    not_a_number, ///< the token is other text
    not_finite,   ///< NaN or infinity, also spelled "1.#INF"
    too_large,    ///< the number is beyond the largest double
};

/// Converts a decimal to the nearest double; numbers that are too small become denormals or zero.
/// The whole token must be the number; a leading '+' is allowed.
[[nodiscard]] NumberState parse_double(std::string_view token, double& value);

/// Converts a decimal integer; false if the whole token is not an integer of 64 bits. A leading '+'
/// is allowed.
[[nodiscard]] bool parse_integer(std::string_view token, std::int64_t& value);

/// Appends the shortest decimal that reads back as the same number (std::to_chars).
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::uint64_t value);

/// Appends "x y z".
void append_point(std::string& out, const Point3& point);

/// Iterates over the lines of a buffer and names the current line in errors. Lines end with \n or
/// \r\n, or with \r if the buffer has no \n. A byte order mark is skipped.
class LineParser {
public:
    LineParser(std::string_view text, std::string_view source);

    /// Goes to the next line; returns false at the end of the buffer.
    bool next();

    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; } ///< from 1
    [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }
    [[nodiscard]] std::string_view source() const { return source_; }

    /// Makes read_number accept the exponents of FORTRAN, as in 1.5D+03.
    void allow_d_exponents() { d_exponents_ = true; }

    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return error_at(number_, code, std::move(sentence));
    }
    [[nodiscard]] Error error_at(std::size_t line, ErrorCode code, std::string sentence) const;
    /// Returns an error about the file as a whole.
    [[nodiscard]] Error file_error(ErrorCode code, std::string sentence) const;

    [[nodiscard]] MaybeError read_number(std::string_view token, double& value) const;
    /// Reads three numbers; `what` names the kind of line in errors.
    [[nodiscard]] MaybeError read_point(Tokens& tokens, std::string_view what, Point3& point) const;

private:
    std::string_view rest_;
    std::string_view line_;
    std::string_view source_;
    std::size_t number_ = 0;
    char line_end_ = '\n';
    bool d_exponents_ = false;
};

} // namespace terrane::detail
