// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// The corners of each side of a tetrahedron, counterclockwise seen from inside, so that a
/// tetrahedron of positive orientation is in front of its sides. The order is that of S1 to S4 in
/// Abaqus.
inline constexpr std::array<std::array<unsigned, 3>, 4> corners_of_side{
    {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

struct TetrahedronSide {
    std::uint32_t tetrahedron = UINT32_MAX; ///< UINT32_MAX: no tetrahedron
    std::uint32_t side = 0;                 ///< 0 to 3

    [[nodiscard]] bool exists() const { return tetrahedron != UINT32_MAX; }
};

/// The tetrahedra on the two sides of a face.
struct FaceSides {
    TetrahedronSide front, back; ///< front: the side from which its corners are counterclockwise
};

/// Returns the tetrahedra on the two sides of each face of the mesh, found by the indices of the
/// vertices only. Cost: O(n log n).
std::vector<FaceSides> sides_of_faces(const TetrahedralMesh& mesh);

} // namespace terrane
