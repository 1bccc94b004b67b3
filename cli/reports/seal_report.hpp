// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What --seal did, for people and for JSON.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

struct SealReport {
    double distance = 0; ///< as asked for
    std::vector<SealChange> changes{};
    double left = 0; ///< see Sealed
};

std::string text_of(const SealReport& report, const Inputs& inputs);

/// distance, changes (kind, surface, length, distance, place, triangles), left.
Json json_of(const SealReport& report);

/// seal: json_of.
void add_statistics(Json& json, const SealReport& report, const Inputs& inputs);

} // namespace terrane::cli
