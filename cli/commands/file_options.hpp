// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/cli/commands/command.hpp>

namespace terrane::cli {

/// Refuses, before any work, a command of which two outputs are the same file, by any of its names,
/// or that would replace one of its inputs by something else than surfaces. Standard input, standard
/// output and devices may be given several times. Errors: bad_option with the option.
Status check_file_options(const CLI::App& command);

/// Refuses values of options that are no number where a number is needed: nan, inf, or nothing.
/// Errors: bad_option with the option.
Status check_values(const CLI::App& command);

} // namespace terrane::cli
