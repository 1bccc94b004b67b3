// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Suggestions for commands and options that are misspelt.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// Returns the name that differs from the word by the fewest letters inserted, left out, replaced or
/// exchanged with their neighbours: at most 2, and at most a third of the word.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

/// Returns a sentence about the first word of the command line that is no command, or no option of the
/// command; none if there is none.
std::optional<std::string> misspelt(const CLI::App& program, std::span<char* const> words);

} // namespace terrane::cli
