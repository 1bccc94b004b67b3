// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/utf8.hpp>

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

} // namespace

bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const unsigned first = static_cast<unsigned char>(text[i++]);
        if (first < 0x80) continue;
        if (first < 0xC0 || first >= 0xF8) return false;
        const Utf8Start start = utf8_start(first);
        std::uint32_t code = start.bits;
        for (std::size_t k = 0; k < start.more; ++k, ++i) {
            const unsigned byte = i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
            if ((byte & 0xC0U) != 0x80) return false;
            code = code << 6U | (byte & 0x3FU);
        }
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        if (code < start.least || surrogate || code > 0x10FFFF) return false;
    }
    return true;
}

} // namespace terrane::detail
