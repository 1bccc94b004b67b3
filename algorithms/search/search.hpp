// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which triangles may meet: pairs of boxes that overlap. All methods give the same pairs.
// Source: the paper, section 2 (structured search, alternating binary trees, mixed search).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace terrane {

enum class Search : std::uint8_t {
    automatic,   ///< grid, or hierarchy where box sizes differ too much for one grid (see choose)
    grid,        ///< structured search, paper 2.1
    ab_balanced, ///< alternating binary tree balanced by quantiles, paper 2.2 and Table 1
    hierarchy,   ///< bounding volume hierarchy: boxes of boxes, for any mixture of sizes
    brute,       ///< every box against every box
};

/// "auto", "grid", "ab-balanced", "hierarchy", "brute".
std::string_view name_of(Search method);

/// Axis-aligned and closed: boxes that touch overlap. low <= high.
struct Box {
    std::array<double, 3> low, high;

    [[nodiscard]] bool overlaps(const Box& o) const {
        return low[0] <= o.high[0] && o.low[0] <= high[0] && low[1] <= o.high[1] &&
               o.low[1] <= high[1] && low[2] <= o.high[2] && o.low[2] <= high[2];
    }
};

/// Two indices of boxes, first < second.
struct CandidatePair {
    std::uint32_t first, second;

    friend auto operator<=>(const CandidatePair&, const CandidatePair&) = default;
};

/// A box whose group is this is paired with all others.
constexpr std::uint32_t no_group = UINT32_MAX;

/// All pairs of overlapping boxes except those within one group; sorted, unique.
/// groups: per box, or empty for none. Boxes of one group are known not to meet (or need no test).
std::vector<CandidatePair> candidate_pairs(std::span<const Box> boxes,
                                           std::span<const std::uint32_t> groups, Search method);

/// All pairs of overlapping boxes of which at least one is active; sorted, unique.
/// active: ascending indices of boxes. Cost: an index of the active boxes, one query per box.
std::vector<CandidatePair> candidate_pairs_of(std::span<const Box> boxes,
                                              std::span<const std::uint32_t> active);

/// What `automatic` stands for: grid, unless the largest box extent exceeds 4 times the mean one
/// along some axis: a grid's cells are as large as the largest box, and so hold too many others.
Search choose(std::span<const Box> boxes);

} // namespace terrane
