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

/// Returns distance, changes (kind, surface, length, distance, place, triangles) and left.
Json json_of(const SealReport& report);

/// Adds "seal" with json_of(report) in it.
void add_statistics(Json& json, const SealReport& report, const Inputs& inputs);

} // namespace terrane::cli
