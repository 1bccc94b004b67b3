// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The nesting of shells: which shells bound the same volume, by lines through the components.
//
// A component is a set of triangles connected by edges. On each connected part of the complement of
// one component there is exactly one of its shells, so a volume is bounded by the outer shells of
// the components inside it and by one shell of the component around it, if any: statements (1) and
// (2) of docs/explanation/shell-nesting.md. For each component a line along an axis passes through
// the inside of one of its triangles, shifted by (epsilon, epsilon^2) so that it meets no edge.
// join_nested goes down each line, from the lowest side of its component to the next one below:
// statement (4). Where hits of lines come from several tiles, sides between all consecutive
// hits are joined: statement (3). Either joins all shells of a volume.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/volumes/complex.hpp>

namespace terrane::volumes {

/// Joins the shells of the same volume; element 2 * triangles of `sides` stands for the outside.
/// The other elements come from join_round_edges. The result is exact, without randomness.
/// Cost: O(n log n) for a tree of boxes if there are several components, and for each of them a search
/// in the tree and, a logarithmic number of times at most, a pass over its triangles; exact arithmetic
/// only where filters fail. Throws std::logic_error if triangles overlap.
void join_nested(const TriangleComplex& sheets, DisjointSets& sides);

/// A line, by its place in a list of triangles through whose insides the lines pass, and a triangle
/// that it meets.
struct LineHit {
    std::uint32_t line = 0, triangle = 0;
};

/// Returns which lines meet which of the first `count` triangles. `through` lists triangles of the same
/// complex, which may lie upon others.
std::vector<LineHit> find_line_hits(const TriangleComplex& sheets,
                                    std::span<const std::uint32_t> through, std::uint32_t count);

/// Calls join(side, other side) for sides between consecutive hits of each line, and with
/// 2 * triangles for the outside. Throws std::logic_error if triangles overlap, or if a line has no
/// hit.
void join_along_lines(const TriangleComplex& sheets, std::span<const std::uint32_t> through,
                      std::span<const LineHit> hits,
                      const std::function<void(std::uint32_t, std::uint32_t)>& join);

} // namespace terrane::volumes
