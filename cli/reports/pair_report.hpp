// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Says what decided the pairs of triangles of a mesh, and adds the option --check.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/check/pair_check.hpp>

namespace terrane::cli {

/// Adds --check.
void add_check(CLI::App& command, PairCheck& method);

/// A line that follows "verified: ..."; empty where nothing was counted.
std::string text_of(const std::optional<PairCounts>& pairs);

} // namespace terrane::cli
