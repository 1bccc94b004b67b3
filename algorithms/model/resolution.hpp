// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Simplifies arranged surfaces to a resolution before they are improved, and tells whether both steps
// together have moved no surface by more than the resolution. Experimental, see simplify.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/simplification/simplify.hpp>

namespace terrane {

/// Simplifies a mesh that is to be improved then. Improvement may deviate by options.max_deviation,
/// or, where that is 0, by the bound of improve(), but at most a quarter of the resolution, which
/// options.max_deviation is set to; joining may move the surfaces by the rest of the resolution, or
/// is refused. Errors: those of simplify(); bad_option (max_deviation is not less than the
/// resolution).
Result<Simplified> simplify_for(const ConformingMesh& mesh, const Resolution& resolution,
                                ImproveOptions& options, const RoundingOptions& rounding = {},
                                const Run& run = {});

/// A mesh that was simplified, and the improved one.
struct ImprovedAtResolution {
    Simplified simplified;
    ImprovedAndMeasured improved;
};

/// Simplifies a mesh, improves it, and shows that both together have moved no surface by more than
/// the resolution. Errors: those of simplify_for() and improve_and_measure(); bad_option (that is
/// not shown).
Result<ImprovedAtResolution> improve_at_resolution(const ConformingMesh& mesh,
                                                   const Resolution& resolution,
                                                   ImproveOptions options,
                                                   const RoundingOptions& rounding = {},
                                                   const Run& run = {});

/// Simplifies the surfaces of `arranged` as simplify_for() does; its mesh must be conforming. Its surfaces,
/// arrangement and mesh become the simplified ones, and `simplified` says what changed.
Status simplify_to(const Resolution& resolution, ImproveOptions& options,
                   const RoundingOptions& rounding, Arranged& arranged, const Run& run = {});

/// Returns the surfaces of the improved mesh, in their order, that are not shown to be within the
/// resolution of their places before simplify_to(), and those within the resolution of them.
/// Surfaces that vanished do not count. Cost: that of is_within().
std::vector<std::uint32_t> beyond_resolution(const AtResolution& simplified, const Mesh& improved,
                                             const Run& run = {});

/// Tells whether each surface of the improved mesh is shown to be within the resolution of its
/// place before simplify_to(), and that within the resolution of it. Surfaces that vanished do not
/// count. Cost: that of is_within().
bool is_within_resolution(const AtResolution& simplified, const Mesh& improved,
                          const Run& run = {});

} // namespace terrane
