// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lines, tokens and numbers of text formats: views into one buffer, no locale, no allocation
// unless there is an error to report.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::detail {

/// Empty where all went well.
using MaybeError = std::optional<Error>;

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lower(std::string_view text);
[[nodiscard]] bool same_ignoring_case(std::string_view a, std::string_view b);

/// A token as it is quoted in messages: at most 40 characters, printable.
[[nodiscard]] std::string shown(std::string_view token);

/// Splits a line at blanks.
class Tokens {
public:
    explicit Tokens(std::string_view line) : rest_(line) {}

    /// The next token; empty at the end of the line.
    std::string_view next() {
        std::size_t begin = 0;
        while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
        std::size_t end = begin;
        while (end < rest_.size() && !is_blank(rest_[end])) ++end;
        const auto token = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        return token;
    }

    /// What is left of the line, without blanks around it.
    [[nodiscard]] std::string_view rest() const { return trimmed(rest_); }

private:
    std::string_view rest_;
};

enum class NumberState {
    ok,
    not_a_number, ///< other text
    not_finite,   ///< NaN or infinity, also as "1.#INF"
    too_large,    ///< beyond the largest double
};

/// Decimal to double, correctly rounded; too small becomes a denormal or zero. '+' may lead.
/// The whole token must be the number.
[[nodiscard]] NumberState parse_double(std::string_view token, double& value);

/// The whole token must be a decimal integer that fits; '+' may lead.
[[nodiscard]] bool parse_integer(std::string_view token, std::int64_t& value);

/// Shortest decimal that reads back as the same double (std::to_chars).
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::uint64_t value);

/// "x y z"
void append_point(std::string& out, const Point3& point);

/// Walks the lines of a buffer and names the current one in errors.
/// Lines end with \n or \r\n, or with \r where the buffer has no \n. A byte order mark is skipped.
class LineParser {
public:
    LineParser(std::string_view text, std::string_view source);

    /// Goes to the next line; false at the end.
    bool next();

    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; } ///< from 1
    [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }
    [[nodiscard]] std::string_view source() const { return source_; }

    /// FORTRAN's exponents 1.5D+03 are numbers too.
    void allow_d_exponents() { d_exponents_ = true; }

    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return error_at(number_, code, std::move(sentence));
    }
    [[nodiscard]] Error error_at(std::size_t line, ErrorCode code, std::string sentence) const;
    /// An error about the file as a whole.
    [[nodiscard]] Error file_error(ErrorCode code, std::string sentence) const;

    [[nodiscard]] MaybeError read_number(std::string_view token, double& value) const;
    /// Three numbers; `what` names the line that needs them.
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
