// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Looks for mistakes that show only once blocks are found; find_doubts() finds the others before.
#pragma once

#include <vector>

#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>

namespace terrane {

/// Returns a warning if surfaces enclose no block and `blocks` are wanted, and one for each pair of
/// horizons that run through each other, which cuts layers into pieces. A surface without a role
/// counts as a horizon if its footprint is most of its area. Cost: linear.
std::vector<PlausibilityWarning> find_model_doubts(const Model& model, bool blocks = true);

} // namespace terrane
