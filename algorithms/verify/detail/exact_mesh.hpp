// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

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

/// Makes a mesh and computes its planes.
ExactMesh make_exact_mesh(std::vector<Vector4> points, const mpz_class& scale,
                          std::span<const Triangle> triangles);

/// Returns the box around each triangle.
std::vector<Box> boxes_of_triangles(const ExactMesh& mesh);

/// Returns the centroid of a triangle.
Vector4 centroid_of(const ExactMesh& mesh, std::uint32_t triangle);

} // namespace terrane::verifier
