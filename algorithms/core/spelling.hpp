// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Suggestions for names that are misspelt.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace terrane {

/// Returns the name that differs from the word by the fewest letters inserted, left out, replaced
/// or exchanged with their neighbours: at most 2, and at most a third of the word.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

} // namespace terrane
