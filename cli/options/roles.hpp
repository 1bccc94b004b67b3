// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options that refer to surfaces by name: NAME=ROLE and NAME=L.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/pipeline/project.hpp>
#include <terrane/cli/options/choices.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

void add_roles(CLI::App& command, std::vector<std::string>& roles);

/// Sets the roles given as NAME=ROLE. Errors: bad_option.
void set_roles(const std::vector<std::string>& roles, Inputs& inputs);

/// Reads a length for a surface or block, NAME=L, split at the last '='.
std::optional<ProjectSize> parse_named_length(std::string_view text);

/// Reads NAME=L with a positive length, or refuses it.
ProjectSize positive_named_length(std::string_view text, const char* option);

/// Reads numbers separated by commas; returns none for anything else.
std::optional<std::vector<double>> numbers_in(std::string_view text);

} // namespace terrane::cli
