// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Horizons put in order: what `layer` and `build` share.
#pragma once

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

/// What was replaced, and whether the doubles are conforming.
std::string text_of(const Inputs& inputs, const Layered& layered);

/// Where the doubles are not conforming: how many pairs, and the first place; empty else.
std::string contacts_text(const Layered& layered);

} // namespace terrane::cli
