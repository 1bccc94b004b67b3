// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What an arrangement in blocks of space did, as JSON and as text.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/distribution/distributed_arrangement.hpp>

namespace terrane::cli {

/// Returns the counts of all blocks and of the one with most of each; `repaired` is null unless the
/// doubles were repaired in one process. docs/reference/statistics.md lists the keys.
nlohmann::ordered_json distribution_json(const distribution::DistributedReport& report,
                                         const RoundingReport* repaired, std::size_t blocks);

/// Returns the lines that sum the result up.
std::string distribution_text(const distribution::DistributedReport& report,
                              const RoundingReport* repaired, const std::string& blocks);

} // namespace terrane::cli
