// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace terrane {

/// Returns the text as XML has it in an element or between the double quotes of an attribute.
/// Control characters become spaces, as XML 1.0 has no way to write most of them, and bytes that are not UTF-8 U+FFFD.
std::string xml_escaped(std::string_view text);

} // namespace terrane
