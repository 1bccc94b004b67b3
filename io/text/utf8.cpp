// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/utf8.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace terrane::detail {

namespace {

/// The first byte of a character of several bytes.
struct Utf8Start {
    std::size_t more = 0;    ///< number of bytes that follow
    std::uint32_t bits = 0;  ///< those of the code in the first byte
    std::uint32_t least = 0; ///< least code with this number of bytes
};

Utf8Start utf8_start(unsigned byte) {
    if (byte >= 0xF0) return {3, byte & 7U, 0x10000};
    if (byte >= 0xE0) return {2, byte & 15U, 0x800};
    return {1, byte & 31U, 0x80};
}

/// Returns how many bytes the first character of a text takes; 0 if the text does not begin with UTF-8. Precondition:
/// the text is not empty.
std::size_t character_size(std::string_view text) {
    const unsigned first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return 1;
    if (first < 0xC0 || first >= 0xF8) return 0;
    const Utf8Start start = utf8_start(first);
    std::uint32_t code = start.bits;
    for (std::size_t k = 1; k <= start.more; ++k) {
        const unsigned byte = k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
        if ((byte & 0xC0U) != 0x80) return 0;
        code = code << 6U | (byte & 0x3FU);
    }
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code < start.least || surrogate || code > 0x10FFFF ? 0 : start.more + 1;
}

} // namespace

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        if (size == 0) return false;
        text.remove_prefix(size);
    }
    return true;
}

std::string as_utf8(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        out += size == 0 ? "\xEF\xBF\xBD" : text.substr(0, size); // U+FFFD
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return out;
}

std::string utf8_of_utf16(std::string_view text) {
    std::string out;
    const bool low_first = text.starts_with("\xFF\xFE");
    if (!low_first && !text.starts_with("\xFE\xFF")) return out;
    const auto unit = [&](std::size_t i) -> std::uint32_t {
        if (i + 1 >= text.size()) return 0;
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
        return low_first ? byte(i) | byte(i + 1) << 8U : byte(i) << 8U | byte(i + 1);
    };
    const auto is_half = [](std::uint32_t code, std::uint32_t first) {
        return code >= first && code < first + 0x400;
    };
    for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
        std::uint32_t code = unit(i);
        if (is_half(code, 0xD800) && is_half(unit(i + 2), 0xDC00)) {
            code = 0x10000 + ((code - 0xD800) << 10U) + (unit(i + 2) - 0xDC00);
            i += 2;
        } else if (code >= 0xD800 && code < 0xE000) {
            code = 0xFFFD;
        }
        const auto add = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
        if (code < 0x80) {
            add(code);
            continue;
        }
        const unsigned more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
        constexpr std::array<std::uint32_t, 3> starts{0xC0, 0xE0, 0xF0};
        add(starts[more - 1] | code >> 6 * more);
        for (unsigned k = more; k-- > 0;) add(0x80 | (code >> 6 * k & 0x3F));
    }
    return out;
}

} // namespace terrane::detail
