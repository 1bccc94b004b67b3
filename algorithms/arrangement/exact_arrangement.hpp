// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Defines the state that an arrangement keeps for later stages and hides from users of the library.
#pragma once

#include <array>
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

/// The state of an arrangement. Indices of vertices, triangles and input triangles are those of the
/// arrangement.
struct ExactState {
    PointStore points;                     ///< all input vertices, and all constructed points
    UninitializedVector<Triangle> corners; ///< per input triangle: for each corner the first input
                                           ///< vertex with the same coordinates
    InjectivePatches patches;              ///< patches of the triangles; the triangles of a patch
                                           ///< never meet improperly
    std::vector<CandidatePair> neighbours; ///< pairs of input triangles that meet, or may meet when
                                           ///< points are rounded to nearest doubles. At least one
                                           ///< has constructed points; they are not both in one
                                           ///< patch. No duplicates; sorted
    std::vector<std::uint32_t> crowded;    ///< input triangles of which `neighbours` leaves pairs
                                           ///< out: those with constructed points at a vertex or
                                           ///< in a pencil so large that a list of all pairs
                                           ///< would be long for the size of the mesh; ascending
    std::vector<std::uint32_t> pools;      ///< per input triangle: its pool, or no_group; empty
                                           ///< without pools. The triangles of a pool lie in one
                                           ///< plane, and `neighbours` leaves their pairs out
    Adjacency adjacency;                   ///< that of the triangles
    bool whole = true;                     ///< false if triangles were removed, see restricted.hpp
    /// Removes the same part from an arrangement of the same surfaces after a small move of their
    /// vertices. Rounding needs it if it arranges again. Empty if `whole`, or if unknown.
    std::function<Result<Arrangement>(Arrangement, const Run&)> restrict_again{};
    bool measures = true; ///< whether restrict_again compares lengths or volumes, so that it needs
                          ///< the unit of the input
    /// Per axis: the coordinates of the planes across it that bound the volume of interest;
    /// ascending. Rounding moves no point off them or over them.
    std::array<std::vector<double>, 3> kept_planes{};
};

/// Returns the state of an arrangement for modification. It is copied first if another arrangement
/// shares it.
ExactState& own_state(Arrangement& arrangement);

} // namespace terrane
