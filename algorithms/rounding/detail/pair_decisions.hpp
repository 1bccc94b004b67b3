// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tells for each pair of triangles of a rounded mesh whether a test decided it, or the proof to
// which the first search, right after rounding to nearest doubles, left it.
//
// (1) A triangle of which a corner was dirty in a search that tests every pair was tested against
//     all triangles whose boxes overlap its own: each change makes corners dirty, and each search
//     tests what has a dirty corner.
// (2) A triangle without such a corner is one of the arrangement, with the same corners. Two of
//     these were decided by the first search.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/check/count_pairs.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>

namespace terrane::rounding::detail {

/// The pools of an arrangement's triangles: the separation of faces says nothing of pairs within one.
struct Pools {
    std::vector<std::uint32_t> of; ///< per triangle: its pool, or no_group; empty without pools
    IndexLists<std::uint32_t> triangles;  ///< of each pool, ascending
    std::vector<bool> is_ill_conditioned; ///< per triangle: see ill_conditioned_in_pools();
                                          ///< empty without pools
    const IndexLists<std::uint32_t>* parents_of = nullptr;

    [[nodiscard]] bool has(std::uint32_t t) const { return !of.empty() && of[t] != no_group; }
    /// Whether two triangles are in one pool.
    [[nodiscard]] bool has_both(const CandidatePair& pair) const {
        return has(pair.first) && of[pair.first] == of[pair.second];
    }
    /// Whether two triangles are in one pool, and may meet improperly after a small move: those of
    /// one face do not if one of them is well conditioned.
    [[nodiscard]] bool need_test(const CandidatePair& pair) const;
};

/// How the first search decided pairs of triangles of the arrangement. Empty lists: it had nothing
/// to decide, since no corner had moved.
struct FirstSearch {
    FirstSearch() = default;
    /// The lists are of triangles.
    FirstSearch(std::vector<CandidatePair> tested, std::span<const std::uint32_t> parts,
                std::span<const std::uint32_t> dirty, std::vector<std::uint32_t> patches_of,
                Pools pools_of);

    std::vector<CandidatePair> pairs;   ///< tested; sorted
    std::vector<std::uint8_t> flags;    ///< per triangle: see pair_decisions.cpp
    std::vector<std::uint32_t> patches; ///< per triangle: its patch, if that still holds; no_group
    Pools pools;

    [[nodiscard]] DecidedBy decided_by(const CandidatePair& pair) const;
};

/// Counts the pairs of the triangles of a state, if the options ask for it. `original`: the triangles
/// of the arrangement.
std::optional<PairCounts> count_decisions(const RoundingState& state,
                                          std::span<const Triangle> original,
                                          const FirstSearch& first, const PairCheckOptions& check,
                                          const Run& run);

} // namespace terrane::rounding::detail
