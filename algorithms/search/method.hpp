// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The methods that find which triangles may meet. All give the same pairs, so that the method decides
// the time alone, never the result. Source: the paper, section 2.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace terrane {

/// How overlapping boxes are found.
enum class Search : std::uint8_t {
    automatic,   ///< bvh, or brute for a handful of boxes (see choose)
    grid,        ///< structured search, paper 2.1
    ab,          ///< alternating binary tree in the order of insertion, paper 2.2: a list at worst
    ab_balanced, ///< alternating binary tree balanced by quantiles, paper 2.2 and Table 1
    mixed,       ///< reduction to cells that several groups share, then a balanced tree, paper 2.3
    bvh,         ///< the same idea for speed and any mixture of sizes: reduction to shared cells,
                 ///< then flat trees of boxes joined leaf by leaf; the only one that uses threads
    brute,       ///< every box against every box
};

// Defined in search.cpp.
/// "auto", "grid", "ab", "ab-balanced", "mixed", "hierarchy", "brute".
std::string_view name_of(Search method);

/// The method of that name.
std::optional<Search> search_named(std::string_view name);

} // namespace terrane
