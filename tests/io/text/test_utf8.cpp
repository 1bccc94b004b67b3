// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/utf8.hpp>

#include <catch2/catch.hpp>

#include <cstdint>
#include <string>

namespace {

using terrane::detail::is_utf8;

/// Encodes a code without asking whether it is one.
std::string encoded(std::uint32_t code, int bytes) {
    if (bytes == 1) return {static_cast<char>(code)};
    std::string text;
    for (int i = bytes - 1; i > 0; --i, code >>= 6U)
        text.insert(text.begin(), static_cast<char>(0x80U | (code & 0x3FU)));
    const unsigned start = 0xFF00U >> static_cast<unsigned>(bytes);
    text.insert(text.begin(), static_cast<char>((start & 0xFFU) | code));
    return text;
}

} // namespace

TEST_CASE("UTF-8: each code in its shortest form, and no other") {
    for (std::uint32_t code = 0; code < 0x200000; code += code < 0x11000 ? 1 : 61) {
        const int shortest = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        const bool is_code = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
        const std::string text = "a" + encoded(code, shortest) + "z";
        if (is_utf8(text) != is_code) FAIL(code);
        for (int longer = shortest + 1; longer <= 4; ++longer)
            if (is_utf8(encoded(code, longer))) FAIL(code << " in " << longer << " bytes");
    }
}

TEST_CASE("UTF-8: cut characters and single bytes are none") {
    CHECK(is_utf8(""));
    CHECK(is_utf8("plain"));
    for (const std::uint32_t code : {0xE9U, 0x20ACU, 0x10348U}) {
        const int bytes = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
        const std::string whole = encoded(code, bytes);
        CHECK(is_utf8(whole));
        for (std::size_t cut = 1; cut < whole.size(); ++cut) {
            CHECK_FALSE(is_utf8(whole.substr(0, cut)));
            CHECK_FALSE(is_utf8(whole.substr(0, cut) + "a"));
            CHECK_FALSE(is_utf8(whole.substr(cut)));
        }
    }
    for (unsigned byte = 0x80; byte < 0x100; ++byte)
        CHECK_FALSE(is_utf8(std::string(1, static_cast<char>(byte))));
}

TEST_CASE("UTF-8: what is none becomes the replacement character, byte by byte") {
    using terrane::detail::as_utf8;
    CHECK(as_utf8("") == "");
    CHECK(as_utf8("caf\u00e9 \u20ac \U0001f30d") == "caf\u00e9 \u20ac \U0001f30d");
    CHECK(as_utf8("caf\xe9, \xe2\x82") == "caf\ufffd, \ufffd\ufffd");
    for (unsigned first = 0; first < 0x100; ++first)
        for (unsigned second = 0; second < 0x100; ++second) {
            const std::string text{static_cast<char>(first), static_cast<char>(second)};
            if (!is_utf8(as_utf8(text)) || (is_utf8(text) && as_utf8(text) != text))
                FAIL(first << " " << second);
        }
}
