// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Manual pages in the language of man(7), from what --help prints.
#pragma once

#include <span>
#include <string>

#include <terrane/cli/options/command_table.hpp>

namespace terrane::cli {

/// What all pages state.
struct ManualSettings {
    std::string version;             ///< "0.1.0"
    std::string description;         ///< of the program, a sentence
    std::string footer;              ///< of the program's --help
    std::string program = "terrane"; ///< as it is called
};

/// Returns terrane(1), which lists the commands.
std::string manual_of_program(std::span<const CommandRow> commands, const ManualSettings& settings);
/// Returns terrane-COMMAND(1). The only command of another program has the page of that program.
std::string manual_of_command(const CommandRow& command, const ManualSettings& settings);

} // namespace terrane::cli
