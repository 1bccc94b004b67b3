// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/xml.hpp>

#include <terrane/io/text/utf8.hpp>

namespace terrane {

std::string xml_escaped(std::string_view text) {
    std::string result;
    for (const char c : detail::as_utf8(text)) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        }
    }
    return result;
}

} // namespace terrane
