// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/cli/commands/command.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

/// Refuses, before any work, a command of which two outputs are the same file, by any of its names, or are both
/// standard output, or one is in the folder that the other one names; that would replace one of its
/// inputs, other than surfaces by those made of them; or of which an output cannot be written. Other
/// devices and pipes may be given several times. Errors: bad_option with the option; cannot_open.
void check_file_options(const CLI::App& command);

/// Does the same for a command that builds a project, with all files that this names and the folder
/// of its results, and keeps the files from being replaced later.
void check_project_files(const CLI::App& command, const Project& project);

/// Refuses, before any work, a command of which an output or an input may be one of the files next to an
/// output of tetrahedra. Errors: bad_option with the option.
void check_files_beside(const CLI::App& command, const std::vector<Output>& outputs);

/// Returns the files that the command reads, without those that it is asked to replace.
std::vector<std::filesystem::path> files_to_keep(const CLI::App& command);

/// Makes a command read each number as the nearest double, as files are read.
void round_numbers_once(CLI::App& command);

/// Refuses values of options that are no number where a number is needed: nothing, nan, infinity,
/// to which numbers too large for a double belong, hexadecimal numbers, and whole ones that begin
/// with 0. Errors: bad_option with the option.
void check_values(const CLI::App& command);

} // namespace terrane::cli
