// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The verifier's own scanner of JSON (RFC 8259). It is stricter than the format: an object has each
// key once, a number is a whole number without sign, fraction or exponent, nothing stands before or
// after the value, and strings are UTF-8. So a text has one reading only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::verifier {

/// The kinds of values that a certificate consists of.
enum class JsonKind : std::uint8_t { null, boolean, integer, string, array, object };

/// Why a text is refused, and at which byte. Parsers of the verifier throw it and catch it.
struct BadJson {
    std::size_t offset = 0; ///< in the text, from 0
    std::string sentence;
};

/// A parsed text: its values in the order of the text, each followed by its members.
class Json {
public:
    /// A value. The key of a member stands before it, as a string.
    struct Value {
        JsonKind kind = JsonKind::null;
        std::uint32_t count = 0;   ///< members; bytes of a string
        std::uint32_t after = 0;   ///< index of the value behind this one and its members
        std::uint64_t content = 0; ///< integer; 0 or 1; first byte of a string in strings
    };

    /// Parses a text. Throws BadJson. Cost: linear; 24 bytes per value.
    explicit Json(std::string_view text);

    [[nodiscard]] const Value& operator[](std::uint32_t index) const { return values_[index]; }
    /// Returns the characters of a string. Precondition: it is one.
    [[nodiscard]] std::string_view string(const Value& value) const {
        return std::string_view(strings_).substr(value.content, value.count);
    }
    /// Returns the index of the value with this key. Precondition: `object` is an object.
    [[nodiscard]] std::optional<std::uint32_t> find(std::uint32_t object,
                                                    std::string_view key) const;

private:
    friend class JsonScanner;
    std::vector<Value> values_;
    std::string strings_; ///< decoded, one after the other
};

/// Returns "line 3, column 7" for a byte of a text.
std::string place_in(std::string_view text, std::size_t offset);

} // namespace terrane::verifier
