// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A secret key that this user's machine keeps. With it the program recognises what it wrote itself.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::cli {

/// A key of the user who runs the program.
class UserKey {
public:
    /// Reads $XDG_STATE_HOME/terrane/stages.key, or ~/.local/state/terrane/stages.key without that
    /// variable. Draws the key at first use; processes that do so at once get the same one. Errors:
    /// cannot_open where there is no key and none can be made, where others than the user may use file or
    /// folder or own it, and where the file is a link, no regular file, or has not the size of a key.
    static Result<UserKey> read_or_make();

    /// Returns the HMAC-SHA256 of a text as 64 lower-case hexadecimal digits.
    [[nodiscard]] std::string code_of(std::string_view text) const;
    /// Tells whether `code` is that of the text. The time for this says nothing about the right code.
    [[nodiscard]] bool is_code_of(std::string_view code, std::string_view text) const;

private:
    std::array<std::uint8_t, 32> bytes_{};
};

} // namespace terrane::cli
