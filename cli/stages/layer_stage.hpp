// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The stage that puts horizons in order: shared by `layer` and `build`.
#pragma once

#include <optional>
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

/// Reports the replaced parts and, where that is so, that the stack is conforming and in order.
/// `step_width` is that of Layered.
std::string text_of(const Inputs& inputs, std::span<const LayerReport> reports,
                    const RoundingReport& rounding, std::optional<double> step_width);

/// Reports the number of pairs in improper contact, else the number of those out of order, and the
/// first place; empty if the stack is conforming and in order.
std::string flaws_text(const RoundingReport& rounding, std::span<const OutOfOrder> out_of_order);

/// Adds the key layers, one entry per layer, with the time and the constants of the rounding.
void add_statistics(Json& json, const Inputs& inputs, std::span<const LayerReport> reports);

} // namespace terrane::cli
