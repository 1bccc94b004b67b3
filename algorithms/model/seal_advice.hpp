// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Helps to choose the distance within which gaps are closed: lists the widths of gaps by their
// natural breaks, and tries each break.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/core/fields.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>

namespace terrane {

/// The model that results from one distance.
struct SealTrial {
    double distance = 0;       ///< 0: nothing is sealed
    std::size_t blocks = 0;    ///< that the exact surfaces enclose
    std::size_t small = 0;     ///< of them, below `small_volume`
    std::size_t changes = 0;   ///< parts of borders that were extended or trimmed
    std::size_t triangles = 0; ///< added and removed
    double length = 0;         ///< of the borders that changed, unit of the input
    double left = 0;           ///< of free borders that are as near to another surface still
};

/// The breaks in the widths of gaps, and the models that result from closing them.
struct SealAdvice {
    SealChoice choice;               ///< the breaks, and the distance that is chosen among them
    double small_volume = 0;         ///< see small_volume_for()
    std::vector<SealTrial> trials{}; ///< without sealing first, then for each break
};

/// Finds the breaks and tries each of them; `options.seal` is ignored, but rules hold. The cost is that of
/// arrange_within() for each trial, without rounding. Errors: those of arrange_within.
Result<SealAdvice> advise_seal(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options = {}, const Run& run = {});

} // namespace terrane
