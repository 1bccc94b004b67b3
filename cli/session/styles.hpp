// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Marks in texts that say what a part means; print() turns them into colours on a terminal, and into
// nothing elsewhere.
#pragma once

#include <string>
#include <string_view>

namespace terrane::cli {

/// Marks a part of a text. Marks are control characters, which names on one line do not have, and a
/// colour ends with its line.
/// @{
std::string good(std::string_view text);     ///< verified: green
std::string bad(std::string_view text);      ///< wrong, or refused: red
std::string doubtful(std::string_view text); ///< a warning: yellow
std::string heading(std::string_view text);  ///< of a table or list: bold
/// @}

/// Marks the headings of a help text: lines such as "Options:".
std::string with_headings(std::string_view help);

/// Returns a text as it goes to a stream: marks become colours or vanish, and control characters
/// other than line ends and tabs become their codes ("\u001b"), so that no name can move the cursor,
/// choose a colour, or turn the text round. Controls of two bytes (U+0080 to U+009F), stray bytes
/// that 8-bit terminals take for them, and what reorders() are among those.
std::string rendered(std::string_view text, bool coloured);

/// Tells whether a text is ASCII without marks and controls, so that it is rendered as it is. Texts may
/// be long: all findings of a check, as JSON.
bool is_plain(std::string_view text);

/// Returns a text without marks, for files.
std::string without_marks(std::string_view text);

} // namespace terrane::cli
