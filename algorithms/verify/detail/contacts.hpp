// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Rule R5 of the verifier: the pairs of triangles that meet improperly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/verify/detail/exact_mesh.hpp>

namespace terrane::verifier {

/// Tells whether two triangles with area, as closed sets, have exactly the convex hull of their
/// shared corners in common: nothing, a corner or an edge. It is true if they share all three
/// corners, which another rule judges.
/// Cost: six to some thirty multiplications of integers.
bool meet_properly(const ExactMesh& mesh, std::uint32_t first, std::uint32_t second);

/// Returns the pairs (lower index first, sorted) of triangles with area that do not meet properly and of which the second
/// is `first` or a later one. It stops after the first such triangle with which there are `at_most` pairs or more.
/// Cost: O(n log n) to find the k pairs to test, and k exact tests. These are the pairs whose boxes touch, but of those
/// at a vertex that many have in common, only the pairs with common directions there.
std::vector<std::array<std::uint32_t, 2>>
find_improper_pairs(const ExactMesh& mesh, std::size_t at_most, std::uint32_t first = 0);

} // namespace terrane::verifier
