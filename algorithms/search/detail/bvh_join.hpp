// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Implements Search::bvh: reduces the boxes to those that may meet, then joins trees leaf by leaf.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// Returns the pairs that candidate_pairs describes. It builds
/// one tree per group (one for all if there are many groups) and joins each with the others, a tree
/// of boxes without group also with itself. Cost: linear in boxes and pairs, up to a factor for the
/// depth of the trees.
std::vector<CandidatePair> bvh_pairs(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                                     const Run& run, const CrowdFinder& find_crowds = {},
                                     bool* any_crowded = nullptr);

/// Returns what find_crowds says of the boxes for which bvh_pairs would ask it; empty if it would not.
std::vector<std::uint32_t> crowds_of_busy(const BoxSource& boxes,
                                          std::span<const std::uint32_t> groups, const Run& run,
                                          const CrowdFinder& find_crowds);

/// Implements candidate_pairs_of.
std::vector<CandidatePair> active_pairs(const BoxSource& boxes,
                                        std::span<const std::uint32_t> active,
                                        std::span<const std::uint32_t> groups,
                                        const PairFilter& filter, const Run& run);

/// Implements count_candidate_pairs.
std::optional<std::array<std::uint64_t, pair_classes>> bvh_counts(const BoxSource& boxes,
                                                                  const PairClassifier& class_of,
                                                                  std::uint64_t most,
                                                                  const Run& run);

/// Returns all pairs of overlapping boxes except those within one group or one crowd and those that
/// the filter (if any) rejects; in any order, each once. crowds: per box, or no_group.
std::vector<CandidatePair> pairs_of_crowds(std::span<const Box> boxes,
                                           std::span<const std::uint32_t> groups,
                                           std::span<const std::uint32_t> crowds,
                                           const PairFilter& filter, const Run& run);

/// Merges and sorts pairs of indices below `count`.
std::vector<CandidatePair> sorted(const std::vector<std::vector<CandidatePair>>& blocks,
                                  std::size_t count);

} // namespace terrane::search
