// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What --seal did, for people and for JSON.
#pragma once

#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

std::string text_of(const SealReport& report, const Inputs& inputs);

/// distance, changes (kind, surface, length, distance, place, triangles), left.
Json json_of(const SealReport& report);

/// seal: json_of.
void add_statistics(Json& json, const SealReport& report, const Inputs& inputs);

} // namespace terrane::cli
