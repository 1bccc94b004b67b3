// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What `terrane check` says, for people and for programs.
#pragma once

#include <string>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Counts, then the first findings of each kind, or all of them. `source` is what was read.
std::string report_text(const CheckReport& report, const Inputs& inputs, const std::string& source,
                        bool all);

/// Everything. Triangles are {"surface": index, "triangle": number within it}, from 0.
Json json_of(const CheckReport& report, const Inputs& inputs);

} // namespace terrane::cli
