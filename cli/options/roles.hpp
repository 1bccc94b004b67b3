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

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/cli/options/files.hpp>

namespace terrane::cli {

void add_roles(CLI::App& command, std::vector<std::string>& roles);

/// Sets the roles NAME=ROLE. Errors: bad_option.
Status set_roles(const std::vector<std::string>& roles, Inputs& inputs);

/// The surfaces with this name; `labels`: per surface its name, made unique, which will do as well.
std::vector<std::uint32_t> surfaces_called(std::string_view name,
                                           std::span<const SurfaceInfo> surfaces,
                                           std::span<const std::string> labels);

/// NAME=L, cut at the last '='; none where that fails.
struct NamedLength {
    std::string name;
    double length = 0;
};
std::optional<NamedLength> parse_named_length(std::string_view text);

} // namespace terrane::cli
