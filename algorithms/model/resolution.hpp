// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Simplifies arranged surfaces to a resolution before they are improved, and tells whether both steps
// together have moved no surface by more than the resolution. Experimental, see simplify.hpp.
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

namespace terrane {

/// The resolution of a model.
struct Resolution {
    double length = 0;     ///< places that are nearer are joined, if they can be; > 0
    bool dissolve = false; ///< blocks thinner than the resolution may go, see SimplifyOptions
};

/// Simplifies the surfaces of `arranged`, whose mesh must be conforming: its surfaces, arrangement
/// and mesh become the simplified ones, and `simplified` says what changed. Improvement may then
/// deviate by options.max_deviation, or, where that is 0, by what improve() would allow, but at
/// most a quarter of the resolution, which options.max_deviation is set to; joining may move the
/// surfaces by the rest of the resolution, or is refused. Errors: those of simplify(); bad_option (max_deviation is not
/// less than the resolution).
Status simplify_to(const Resolution& resolution, ImproveOptions& options,
                   const RoundingOptions& rounding, Arranged& arranged, const Run& run = {});

/// Tells whether each surface of the improved mesh is shown to be within the resolution of what it
/// was before simplify_to(), and that within the resolution of it. Surfaces that vanished do not
/// count. Cost: that of is_within().
bool is_within_resolution(const AtResolution& simplified, const Mesh& improved,
                          const Run& run = {});

} // namespace terrane
