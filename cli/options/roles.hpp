// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Surfaces by name, as they are said on the command line.
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

/// Sets the roles NAME=ROLE. Errors: bad_option.
Status set_roles(const std::vector<std::string>& roles, Inputs& inputs);

/// NAME=L, cut at the last '='; none where that fails.
struct NamedLength {
    std::string name;
    double length = 0;
};
std::optional<NamedLength> parse_named_length(std::string_view text);

} // namespace terrane::cli
