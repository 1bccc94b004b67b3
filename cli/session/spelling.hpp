// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Suggestions for commands and options that are misspelt.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// Returns a sentence about the first word of the command line that is no command, or no option of
/// the command; without such a word no sentence.
std::optional<std::string> misspelt(const CLI::App& program, std::span<char* const> words);

} // namespace terrane::cli
