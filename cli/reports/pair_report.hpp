// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What decided the pairs of triangles of a mesh, for people and for JSON; and the option --check.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/check/pair_check.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Adds --check.
void add_check(CLI::App& command, PairCheck& method);

/// A line that follows "verified: ..."; empty where nothing was counted.
std::string text_of(const std::optional<PairCounts>& pairs);

/// tested, in_patches, separated, unmoved, apart.
Json json_of(const PairCounts& pairs);

} // namespace terrane::cli
