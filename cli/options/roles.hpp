// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Options that refer to surfaces by name: NAME=ROLE and NAME=L.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

void add_roles(CLI::App& command, std::vector<std::string>& roles);

/// Sets the roles given as NAME=ROLE. Errors: bad_option.
Status set_roles(const std::vector<std::string>& roles, Inputs& inputs);

/// Returns the roles of the surfaces.
std::vector<Role> roles_of(const Inputs& inputs);

/// A length for a surface or block, given as NAME=L and split at the last '='.
struct NamedLength {
    std::string name;
    double length = 0;
};
std::optional<NamedLength> parse_named_length(std::string_view text);

} // namespace terrane::cli
