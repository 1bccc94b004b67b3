// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What an arrangement keeps for the stages after it and hides from users of the library.
#pragma once

#include <functional>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/core/uninitialized_vector.hpp>
#include <terrane/algorithms/intersection/injective_patches.hpp>
#include <terrane/algorithms/mesh/adjacency.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane {

/// Indices into `vertices`, `triangles` and input triangles are those of the arrangement.
struct ExactState {
    PointStore points;                     ///< all input vertices, and all constructed points
    UninitializedVector<Triangle> corners; ///< per input triangle: input vertices at the first
                                           ///< place where their coordinates occur
    InjectivePatches patches;              ///< of the triangles: within one, none meet improperly
    std::vector<CandidatePair> neighbours; ///< input triangles, one of them with constructed
                                           ///< points, not both within one patch, that meet or may
                                           ///< do so when points are rounded to nearest doubles;
                                           ///< no duplicates; sorted
    Adjacency adjacency;                   ///< of the triangles
    bool whole = true;                     ///< false: some triangles were taken out, see
                                           ///< restricted.hpp
    /// Takes the same out of an arrangement of the same surfaces after a small move of their
    /// vertices: rounding needs it where it arranges anew. Empty where `whole`, or not known.
    std::function<Result<Arrangement>(Arrangement, const Run&)> restrict_again{};
};

/// The state of an arrangement, to be changed: copied first where another arrangement shares it.
ExactState& own_state(Arrangement& arrangement);

} // namespace terrane
