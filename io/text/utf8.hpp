// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

namespace terrane::detail {

/// Tells whether a text is UTF-8: without cut or overlong characters, surrogates, and codes above
/// 0x10FFFF.
[[nodiscard]] bool is_utf8(std::string_view text);

} // namespace terrane::detail
