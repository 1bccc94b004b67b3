// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on --resolution, as text and as JSON.
#pragma once

#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/reports/improve_report.hpp>

namespace terrane::cli {

/// Lists joined places, the changes by joining, and places left alone; 20 of each at most.
std::string text_of(const SimplifyReport& report, const Inputs& inputs);

/// Reports on arranged surfaces if they were simplified, as text and in `json`; empty otherwise.
std::string resolution_text(Json& json, const Arranged& arranged, const Inputs& inputs);

/// Adds "resolution": counts, changes, deviations, and all that was left alone.
void add_statistics(Json& json, const SimplifyReport& report, const Inputs& inputs);

} // namespace terrane::cli
