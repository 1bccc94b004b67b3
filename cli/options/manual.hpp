// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Manual pages in the language of man(7), from what --help prints.
#pragma once

#include <span>
#include <string>

#include <terrane/cli/options/command_table.hpp>

namespace terrane::cli {

/// The facts that all pages state.
struct ManualSettings {
    std::string version;             ///< "0.1.0"
    std::string description;         ///< of the program, a sentence
    std::string footer;              ///< of the program's --help
    std::string program = "terrane"; ///< the command line begins with it
};

/// Returns terrane(1), which lists the commands.
std::string manual_of_program(std::span<const CommandRow> commands, const ManualSettings& settings);
/// Returns the page of a command, which is called `name`: terrane-arrange(1), terrane-mpi(1).
std::string manual_of_command(const CommandRow& command, const std::string& name,
                              const ManualSettings& settings);

} // namespace terrane::cli
