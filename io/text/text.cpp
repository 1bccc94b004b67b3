// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace terrane::detail {

namespace {

constexpr char to_lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}
constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string_view without_plus(std::string_view token) {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
    return token;
}

/// Tells whether a decimal outside the range of double is too small (true) or too large (false), by
/// the position of its first nonzero digit.
bool is_below_one(std::string_view token) {
    const auto e = std::min(token.find_first_of("eE"), token.size());
    const auto mantissa = token.substr(0, e);
    const auto point = std::min(mantissa.find('.'), mantissa.size());
    const auto digit = std::min(mantissa.find_first_of("123456789"), mantissa.size());
    auto power = static_cast<double>(point) - static_cast<double>(digit);
    if (e < token.size()) {
        const bool negative =
            token.substr(e).starts_with("e-") || token.substr(e).starts_with("E-");
        double exponent = 0;
        for (const char c : token.substr(e))
            if (is_digit(c)) exponent = exponent * 10 + (c - '0');
        power += negative ? -exponent : exponent;
    }
    return power < 0;
}

NumberState out_of_range(std::string_view token, double& value) {
    if (!is_below_one(token)) return NumberState::too_large;
    value = token.front() == '-' ? -0.0 : 0.0;
    return NumberState::ok;
}

template <class Number>
void append_shortest(std::string& out, Number value) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    out.append(buffer, static_cast<std::size_t>(end - buffer));
}

} // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string replaced_texts(std::string_view text, std::string_view from, std::string_view to) {
    std::string out;
    for (auto at = text.find(from); at != std::string_view::npos; at = text.find(from)) {
        out.append(text.substr(0, at)).append(to);
        text.remove_prefix(at + from.size());
    }
    return out.append(text);
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), to_lower);
    return result;
}

bool same_ignoring_case(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return to_lower(x) == to_lower(y); });
}

std::string csv_cell(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    return '"' + replaced_texts(text, "\"", "\"\"") + '"';
}

std::string shown(std::string_view token) {
    constexpr std::size_t longest = 40;
    std::string result = "\"";
    for (const char c : token.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
    return result + (token.size() > longest ? "...\"" : "\"");
}

NumberState parse_double(std::string_view token, double& value) {
    token = without_plus(token);
    const auto last = token.data() + token.size();
    const auto [end, code] = std::from_chars(token.data(), last, value);
    if (code == std::errc::invalid_argument) return NumberState::not_a_number;
    if (end != last) {
        const bool windows = *end == '#' && end + 1 != last && (end[1] == 'I' || end[1] == 'Q');
        return windows ? NumberState::not_finite : NumberState::not_a_number;
    }
    if (code == std::errc::result_out_of_range) return out_of_range(token, value);
    if (std::isfinite(value)) return NumberState::ok;
    const char first = token.front() == '-' ? token[1] : token[0];
    return is_digit(first) || first == '.' ? NumberState::too_large : NumberState::not_finite;
}

bool parse_integer(std::string_view token, std::int64_t& value) {
    token = without_plus(token);
    const auto last = token.data() + token.size();
    const auto [end, code] = std::from_chars(token.data(), last, value);
    return code == std::errc() && end == last;
}

void append_number(std::string& out, double value) {
    append_shortest(out, value);
}
void append_number(std::string& out, float value) {
    append_shortest(out, value);
}
void append_number(std::string& out, std::uint64_t value) {
    const fmt::format_int digits(value);
    out.append(digits.data(), digits.size());
}

void append_point(std::string& out, const Point3& point) {
    append_number(out, point.x);
    out += ' ';
    append_number(out, point.y);
    out += ' ';
    append_number(out, point.z);
}

LineParser::LineParser(std::string_view text, std::string_view source) :
    rest_(text), source_(source) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    if (rest_.find('\n') == std::string_view::npos) line_end_ = '\r';
}

bool LineParser::next() {
    if (rest_.empty()) return false;
    const auto end = std::min(rest_.find(line_end_), rest_.size());
    line_ = rest_.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
}

Error LineParser::error_at(std::size_t line, ErrorCode code, std::string sentence) const {
    return {code, std::move(sentence), fmt::format("{}:{}", source_, line)};
}

Error LineParser::file_error(ErrorCode code, std::string sentence) const {
    return {code, std::move(sentence), std::string(source_)};
}

MaybeError LineParser::read_number(std::string_view token, double& value) const {
    auto state = parse_double(token, value);
    if (state == NumberState::not_a_number && d_exponents_) {
        std::string with_e(token);
        std::replace_if(
            with_e.begin(), with_e.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
        state = parse_double(with_e, value);
    }
    switch (state) {
    case NumberState::ok:
        return std::nullopt;
    case NumberState::not_finite:
        return error(ErrorCode::bad_number, shown(token) + " is not a finite number");
    case NumberState::too_large:
        return error(ErrorCode::bad_number, shown(token) + " does not fit in a double");
    case NumberState::not_a_number:
        break;
    }
    return error(ErrorCode::bad_syntax, shown(token) + " is not a number");
}

MaybeError LineParser::read_point(Tokens& tokens, std::string_view what, Point3& point) const {
    for (double* coordinate : {&point.x, &point.y, &point.z}) {
        const auto token = tokens.next();
        if (token.empty())
            return error(ErrorCode::bad_syntax, fmt::format("{} needs 3 numbers", what));
        if (auto trouble = read_number(token, *coordinate)) return trouble;
    }
    return std::nullopt;
}

} // namespace terrane::detail
