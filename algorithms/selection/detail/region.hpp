// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The region that a question selects of an exact arrangement.
#pragma once

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/selection/detail/oriented.hpp>
#include <terrane/algorithms/selection/detail/question.hpp>

namespace terrane::selection {

/// Restricts an arrangement to the boundary of the region, or to the part of the open surface that is selected.
/// Rounding, if it moves the surfaces, selects the same region of them again. Errors: not_closed; those of
/// find_volumes().
Result<SelectedRegion> region_in(Arrangement exact, const Question& question, const Run& run);

} // namespace terrane::selection
