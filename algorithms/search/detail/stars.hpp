// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds pairs among triangles that share a crowded vertex. All their boxes overlap there, so boxes
// say nothing. Their directions round the vertex tell the triangles apart:
// (1) Two triangles with the vertex v meet elsewhere only if there is a direction from v along which
//     both extend. A triangle's directions are an arc of a great circle, its edge of the link of v.
//     So arcs whose boxes are apart show that the triangles meet in v only.
// (2) The arcs of triangles with an edge (v, w) in common all begin at w's direction. If many do,
//     two of them meet outside of the edge only if they lie in one half-plane at the edge's line:
//     if their directions across the line are equal.
// Boxes are widened by more than the errors of their computation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/search/search.hpp>

namespace terrane::search {

/// By how much boxes around directions are widened. kernel/proofs/star_*.g are proofs that Gappa
/// checks with these numbers.
/// A direction across a line errs by at most this over the sine of its angle with the line.
inline constexpr double across_error = 0x1p-44;
/// An arc between directions whose sum is longer than least_middle is within this, and what it
/// bulges over its chord, of the chord.
inline constexpr double arc_error = 0x1p-36, least_middle = 0.01;

/// Disjoint sets of triangles, each at one crowded vertex.
struct Stars {
    std::vector<std::uint32_t> of; ///< per triangle: its star or no_group; empty without stars
    std::vector<std::uint32_t> vertices; ///< per star: the vertex that its triangles share
    IndexLists<std::uint32_t> triangles; ///< per star: ascending
};

/// Assigns each chosen triangle with a crowded corner to one star. `chosen` is ascending; corners
/// count as crowded by the chosen triangles alone. A list of boxes has no stars.
Stars find_stars(const BoxSource& source, std::span<const std::uint32_t> chosen);

/// Returns the pairs of triangles of a star that may meet improperly, except those within one group;
/// sorted, unique. Cost: that of a search among as many boxes.
std::vector<CandidatePair> pairs_of_star(const BoxSource& source, const Stars& stars,
                                         std::size_t star, std::span<const std::uint32_t> groups,
                                         const Run& run);

} // namespace terrane::search
