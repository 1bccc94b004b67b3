// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports of `terrane check`, as text and as JSON.
#pragma once

#include <string>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Reports counts, then the first findings of each kind or, with `all`, every one. `source` names
/// the input.
std::string report_text(const CheckReport& report, const Inputs& inputs, const std::string& source,
                        bool all);

/// Returns all findings. A triangle is {"surface": index, "triangle": number within it}, both from
/// 0.
Json json_of(const CheckReport& report, const Inputs& inputs);

} // namespace terrane::cli
