// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on --seal, as text and as JSON.
#pragma once

#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

std::string text_of(const SealReport& report, const Inputs& inputs);

/// Reports the natural breaks in the widths of gaps, and the distance that was chosen.
std::string text_of(const SealChoice& choice, const Inputs& inputs);

/// Adds "seal_choice": edge_length, widest, breaks, distance.
void add_statistics(Json& json, const SealChoice& choice);

/// Reports the models that the distances lead to, as a table.
std::string text_of(const SealAdvice& advice, const Inputs& inputs);

/// Adds "seal_choice" and "seal_trials".
void add_statistics(Json& json, const SealAdvice& advice);

/// Adds "seal": distance, changes, left, open and, if there are any, rules.
void add_statistics(Json& json, const SealReport& report, const Inputs& inputs);

} // namespace terrane::cli
