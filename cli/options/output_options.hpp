// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options of every command that say what it shows: --quiet and --color.
#pragma once

#include <CLI/CLI.hpp>

#include <terrane/cli/session/terminal.hpp>

namespace terrane::cli {

void add_output_options(CLI::App& command);

/// Returns what the options ask for, of the command that was given; also after an error in others.
OutputSettings output_settings(const CLI::App& program);

} // namespace terrane::cli
