// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/styles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <terrane/cli/session/text_width.hpp>

namespace terrane::cli {
namespace {

/// A style begins with its mark and ends with end_mark.
constexpr char good_mark = 1, bad_mark = 2, doubtful_mark = 3, heading_mark = 4, end_mark = 5;
/// The escape sequence of each mark, by its number.
constexpr std::array<std::string_view, 6> sequences{"",         "\033[32m", "\033[31m",
                                                    "\033[33m", "\033[1m",  "\033[0m"};

std::string marked(char mark, std::string_view text) {
    std::string result(1, mark);
    std::ranges::replace_copy_if(
        text, std::back_inserter(result), [](char c) { return c >= good_mark && c <= end_mark; },
        ' ');
    return result + end_mark;
}

bool is_continuation(std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80;
}

/// Returns the number of bytes of the UTF-8 sequence at a place; 0 if there is none.
std::size_t sequence_length(std::string_view text, std::size_t at) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!is_continuation(text, at + i)) return 0;
    return length;
}

/// Returns the code of a character of at most three bytes; 0 for longer ones.
char32_t code_of(std::string_view bytes) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    switch (bytes.size()) {
    case 1:
        return at(0);
    case 2:
        return (at(0) & 0x1FU) << 6U | (at(1) & 0x3FU);
    case 3:
        return (at(0) & 0x0FU) << 12U | (at(1) & 0x3FU) << 6U | (at(2) & 0x3FU);
    default:
        return 0;
    }
}

/// Tells whether the bytes are a control character, one for an 8-bit terminal, or one that changes
/// the direction of what follows.
bool is_control(std::string_view bytes) {
    const char32_t code = code_of(bytes);
    const bool is_old = code < 0x20 || (code >= 0x7F && code < 0xA0);
    return (bytes.size() <= 2 && is_old) || reorders(code);
}

/// Writes a control character as its code, a stray byte as "\x9b".
std::string visible(std::string_view bytes) {
    const auto code = static_cast<std::uint32_t>(code_of(bytes));
    const bool stray = bytes.size() == 1 && code >= 0x80;
    return stray ? fmt::format("\\x{:02x}", code) : fmt::format("\\u{:04x}", code);
}

} // namespace

std::string good(std::string_view text) {
    return marked(good_mark, text);
}

std::string bad(std::string_view text) {
    return marked(bad_mark, text);
}

std::string doubtful(std::string_view text) {
    return marked(doubtful_mark, text);
}

std::string heading(std::string_view text) {
    return marked(heading_mark, text);
}

std::string with_headings(std::string_view help) {
    std::string result;
    while (!help.empty()) {
        const std::size_t end = std::min(help.find('\n'), help.size() - 1);
        const std::string_view line = help.substr(0, end + 1);
        help.remove_prefix(end + 1);
        const bool is_heading =
            line.size() > 2 && line[0] >= 'A' && line[0] <= 'Z' && line.ends_with(":\n");
        result += is_heading ? heading(line.substr(0, line.size() - 1)) + '\n' : std::string(line);
    }
    return result;
}

bool is_plain(std::string_view text) {
    return std::ranges::all_of(
        text, [](unsigned char c) { return (c >= 0x20 && c < 0x7F) || c == '\n' || c == '\t'; });
}

std::string rendered(std::string_view text, bool coloured) {
    std::string result;
    result.reserve(text.size());
    bool open = false; // whether a colour is on, which ends with its line at the latest
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        const std::size_t length = std::max<std::size_t>(sequence_length(text, at), 1);
        const std::string_view bytes = text.substr(at, length);
        at += length;
        if (c >= good_mark && c <= end_mark) {
            if (coloured) result += sequences[static_cast<unsigned char>(c)];
            open = coloured && c != end_mark;
        } else if (c != '\n' && c != '\t' && is_control(bytes)) {
            result += visible(bytes);
        } else {
            if (c == '\n' && std::exchange(open, false)) result += sequences[end_mark];
            result += bytes;
        }
    }
    return open ? result.append(sequences[end_mark]) : result;
}

std::string without_marks(std::string_view text) {
    std::string result(text);
    std::erase_if(result, [](char c) { return c >= good_mark && c <= end_mark; });
    return result;
}

} // namespace terrane::cli
