// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Lists the methods that find the pairs of triangles that may meet. All methods find the same
// pairs, so the choice affects the time only. Source: the paper, section 2.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace terrane {

/// Methods that find overlapping boxes.
enum class Search : std::uint8_t {
    automatic,   ///< bvh, or brute for a handful of boxes (see choose)
    grid,        ///< structured search, paper 2.1
    ab,          ///< alternating binary tree, boxes inserted in the given order, paper 2.2; it
                 ///< degenerates to a list in the worst case
    ab_balanced, ///< alternating binary tree, boxes inserted in the order of the quantiles of
                 ///< Table 1, paper 2.2; on surfaces about twice as deep as the next
    ab_median,   ///< alternating binary tree that divides each subtree at the median of its own
                 ///< boxes, the other reading of Table 1; no tree is shallower
    mixed,       ///< reduction to cells that several groups share, then a balanced tree, paper 2.3
    bvh,         ///< reduction to shared cells, then flat bounding volume hierarchies joined leaf
                 ///< by leaf: fast for any mixture of sizes, the only method that uses threads
    brute,       ///< every box against every box
};

// The following functions are defined in search.cpp.

/// Returns the name of a method: "auto", "grid", "ab", "ab-balanced", "ab-median", "mixed",
/// "hierarchy" (bvh) or "brute".
std::string_view name_of(Search method);

/// Returns the method with a name, or std::nullopt.
std::optional<Search> search_named(std::string_view name);

} // namespace terrane
