// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// Adds an option for a positive length.
void add_positive_length(CLI::App& command, const std::string& name, std::optional<double>& value,
                         const std::string& help);
/// Adds --max-move, see RoundingOptions::max_move.
void add_max_move(CLI::App& command, std::optional<double>& max_move);

} // namespace terrane::cli
