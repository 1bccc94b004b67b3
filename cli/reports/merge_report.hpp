// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on --tolerance and --min-volume, as text and as JSON.
#pragma once

#include <string>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Lists the blocks that became part of others; 20 at most.
std::string text_of(const BlockMerge& report, const Inputs& inputs);

/// Adds "small_blocks": least_volume, kept, and merged, one entry per block.
void add_statistics(Json& json, const BlockMerge& report, const Inputs& inputs);

/// Says what was joined within a tolerance, and lists thin cells that were left; 20 at most.
std::string text_of(const ToleranceReport& report, const Inputs& inputs);

/// Adds "tolerance": what ToleranceReport says, and `left`, one entry per thin cell.
void add_statistics(Json& json, const ToleranceReport& report, const Inputs& inputs);

} // namespace terrane::cli
