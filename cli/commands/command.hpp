// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include <terrane/cli/session/console.hpp>

namespace terrane::cli {

/// One command of the program: its CLI11 options, and the function that runs it once they are
/// parsed.
struct Command {
    CLI::App* options = nullptr;
    std::function<ExitStatus()> run;
};

Command arrange_command(CLI::App& program);
Command build_command(CLI::App& program);
Command check_command(CLI::App& program);
Command info_command(CLI::App& program);
Command completion_command(CLI::App& program);
Command convert_command(CLI::App& program);
Command ensemble_command(CLI::App& program);
Command fill_command(CLI::App& program);
Command grid_command(CLI::App& program);
Command improve_command(CLI::App& program);
Command judge_command(CLI::App& program);
Command layer_command(CLI::App& program);
Command manual_command(CLI::App& program);
Command minimise_command(CLI::App& program);
Command pillars_command(CLI::App& program);
Command prisms_command(CLI::App& program);
Command report_command(CLI::App& program);
Command section_command(CLI::App& program);
Command select_command(CLI::App& program);
Command map_command(CLI::App& program);
Command tetrahedralize_command(CLI::App& program);
Command verify_command(CLI::App& program);
Command view_command(CLI::App& program);
Command volume_command(CLI::App& program);
Command well_command(CLI::App& program);

} // namespace terrane::cli
