// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Meshes whose triangles know of which triangles of the first mesh they are images, and whose
// vertices know how far they have moved since.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/simplification/detail/complex.hpp>

namespace terrane::simplification::detail {

struct TracedMesh {
    Mesh mesh;
    std::vector<Cell> cells; ///< per triangle, with the same corners
    std::vector<Past> past;  ///< per vertex
};

/// The surfaces of a complex, one by one, and where each of their triangles comes from.
struct MovedSoup {
    std::vector<Surface> surfaces;
    std::vector<CellLayer> layers; ///< per triangle, through all surfaces; its own orientation
    std::vector<Past> past;        ///< per vertex, through all surfaces
};

/// Numbers a mesh by place: vertices in lexicographic order, triangles by their corners.
TracedMesh traced(const Mesh& mesh);

MovedSoup soup_of(const Complex& complex, std::span<const SurfaceInfo> surfaces);

/// Traces the rounded arrangement of a soup, numbered as it is. `rounded`: how far vertices moved
/// in rounding.
TracedMesh traced(const Mesh& mesh, const MovedSoup& soup, double rounded);

} // namespace terrane::simplification::detail
