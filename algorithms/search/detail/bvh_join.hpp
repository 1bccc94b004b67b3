// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The search that `automatic` stands for: reduction to what can meet, then trees joined leaf by
// leaf.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// Search::bvh. A tree per group (one for all where groups are many), each joined with itself
/// or with the others. Cost: linear in boxes and pairs but for the depth of the trees.
std::vector<CandidatePair> bvh_pairs(const BoxSource& boxes, std::span<const std::uint32_t> groups,
                                     const Run& run);

/// All pairs of which at least one is active (ascending indices) and that the filter keeps.
std::vector<CandidatePair> active_pairs(const BoxSource& boxes,
                                        std::span<const std::uint32_t> active,
                                        std::span<const std::uint32_t> groups,
                                        const PairFilter& filter, const Run& run);

/// Sorts pairs of indices below `count`.
std::vector<CandidatePair> sorted(const std::vector<std::vector<CandidatePair>>& blocks,
                                  std::size_t count);

} // namespace terrane::search
