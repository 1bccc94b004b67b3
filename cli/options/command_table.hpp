// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Commands and options as data, from what --help prints: completion and manual pages are made of it.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace terrane::cli {

/// The kind of the value of an option.
enum class ValueKind {
    none,   ///< a flag
    text,   ///< anything: a number, a name of a surface
    choice, ///< one of `words`
    file,   ///< a file whose name ends in one of `words`; any file if there are none
    folder,
};

struct OptionRow {
    std::vector<std::string> names; ///< "-o", "--output"; empty for a positional argument
    std::string position;           ///< "IN"; empty for an option
    std::string placeholder;        ///< "FILE"
    std::string description, group; ///< as --help prints them
    ValueKind kind = ValueKind::none;
    std::vector<std::string> words; ///< choices, or endings of files: "ts"
    bool required = false, repeated = false;
};

struct CommandRow {
    std::string name, description, footer; ///< as --help prints them
    std::vector<OptionRow> options;        ///< in the order of --help
};

/// Returns the commands in the order of --help.
std::vector<CommandRow> command_table(const CLI::App& program);

/// Returns the rows of positional arguments, or of options.
std::vector<OptionRow> positionals_of(const CommandRow& command);
std::vector<OptionRow> options_of(const CommandRow& command);

} // namespace terrane::cli
