// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Internal to the verifier: rule R5, which pairs of triangles meet as they should not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/rational.hpp>

namespace terrane::verifier {

/// Triangles with exact corners.
struct ExactMesh {
    std::vector<Vector4> points;
    mpz_class scale = 1;
    std::vector<Triangle> triangles; ///< indices into points
    std::vector<Vector4> planes; ///< per triangle: the plane through its corners; zero iff it has
                                 ///< no area
};

/// The planes are computed from the rest.
ExactMesh make_exact_mesh(std::vector<Vector4> points, const mpz_class& scale,
                          std::span<const Triangle> triangles);

/// Whether two triangles with area, both closed sets, share exactly the convex hull of the corners
/// whose indices they share: nothing, a corner or an edge.
/// True if they share all three indices: that is another rule's business.
/// Cost: six to some thirty multiplications of integers.
bool meet_properly(const ExactMesh& mesh, std::uint32_t first, std::uint32_t second);

/// All pairs (lower index first, sorted) of triangles with area that do not meet properly.
/// Gives up after the first triangle with which there are `at_most` pairs or more.
/// Cost: O(n log n) to find the k pairs whose boxes touch, and k exact tests.
std::vector<std::array<std::uint32_t, 2>> find_improper_pairs(const ExactMesh& mesh,
                                                              std::size_t at_most);

} // namespace terrane::verifier
