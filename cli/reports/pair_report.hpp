// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Says what decided the pairs of triangles of a mesh, and adds the option --check.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include <terrane/algorithms/check/check.hpp>

namespace terrane::cli {

/// Unless --check is given, pairs are counted for small meshes only: see count_up_to.
inline constexpr PairCheckOptions few_pairs{PairCheck::bounds, 20'000, 256};

/// Adds --check. Where it is given, pairs are counted in any case.
void add_check(CLI::App& command, PairCheckOptions& check);

/// A line that follows "verified: ..."; empty where nothing was counted.
std::string text_of(const std::optional<PairCounts>& pairs);

} // namespace terrane::cli
