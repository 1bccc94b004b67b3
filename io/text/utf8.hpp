// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace terrane::detail {

/// Tells whether a text is UTF-8: without cut or overlong characters, surrogates, and codes above
/// 0x10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

/// Returns a text in which each byte that is not UTF-8 is U+FFFD, as in JSON.
[[nodiscard]] std::string as_utf8(std::string_view text);

/// Returns a text in UTF-16 that begins with its byte order mark, in UTF-8; empty for any other text.
/// Halves of characters become U+FFFD.
[[nodiscard]] std::string utf8_of_utf16(std::string_view text);

} // namespace terrane::detail
