// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Completion scripts for shells. They name all that they offer, so that completing starts no program.
#pragma once

#include <span>
#include <string>

#include <terrane/cli/options/command_table.hpp>

namespace terrane::cli {

std::string bash_completion(std::span<const CommandRow> commands);
std::string zsh_completion(std::span<const CommandRow> commands);
std::string fish_completion(std::span<const CommandRow> commands);

} // namespace terrane::cli
