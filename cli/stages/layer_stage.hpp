// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Horizons put in order: what `layer` and `build` share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// stack_layers of the inputs, with its time and its report in `statistics` (layers).
Result<Layered> layer_inputs(const Inputs& inputs, const std::vector<Layer>& order,
                             const LayerOptions& options, Session& session, Json& statistics);

/// Tells what was replaced, and whether the doubles are conforming.
std::string text_of(const Inputs& inputs, std::span<const LayerReport> reports,
                    const RoundingReport& rounding);

/// Where the doubles are not conforming: how many pairs, and the first place; empty else.
std::string contacts_text(const RoundingReport& rounding);

/// One entry per layer, for the statistics.
Json json_of(const Inputs& inputs, std::span<const LayerReport> reports);

} // namespace terrane::cli
