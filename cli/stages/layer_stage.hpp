// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The stage that puts horizons in order: shared by `layer` and `build`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/session/session.hpp>

namespace terrane::cli {

/// Runs stack_layers on the inputs, and adds its time and its report (layers) to `statistics`.
Result<Layered> layer_inputs(const Inputs& inputs, const std::vector<Layer>& order,
                             const LayerOptions& options, Session& session, Json& statistics);

/// Reports what was replaced, and whether the rounded mesh is conforming.
std::string text_of(const Inputs& inputs, std::span<const LayerReport> reports,
                    const RoundingReport& rounding);

/// Reports the number of pairs in improper contact and the first place; empty if the rounded mesh
/// is conforming.
std::string contacts_text(const RoundingReport& rounding);

/// Adds the key layers, one entry per layer, with the time and the constants of the rounding.
void add_statistics(Json& json, const Inputs& inputs, std::span<const LayerReport> reports,
                    const StageTimes& times);

} // namespace terrane::cli
