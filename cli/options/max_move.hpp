// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// Adds --max-move, see RoundingOptions::max_move.
void add_max_move(CLI::App& command, std::optional<double>& max_move);

} // namespace terrane::cli
