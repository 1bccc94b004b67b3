// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Warnings about inputs that do not fit together, for every command that takes surfaces.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Prints warnings and adds them to the statistics, under the key warnings. Errors: bad_option if
/// there are some and --strict is given.
void report_doubts(const std::vector<PlausibilityWarning>& warnings,
                   const std::vector<std::string>& labels, bool strict, Json& statistics);

/// Looks for mistakes in the surfaces and reports them, before any work is done on them.
void examine(std::span<const Surface> surfaces, const PlausibilityContext& context,
             const Inputs& inputs, Session& session, Json& statistics);

/// Looks for mistakes that show once blocks are found. That there is no block is said only if
/// `blocks` are wanted and no warning about a missing top or base has said so.
void examine(const Model& model, const Inputs& inputs, bool blocks, Session& session,
             Json& statistics);

} // namespace terrane::cli
