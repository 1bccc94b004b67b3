// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Corners of the sides of a tetrahedron, counterclockwise seen from within: where its orientation
/// is positive it is in front of them. In the order that Abaqus has for S1 to S4.
inline constexpr std::array<std::array<unsigned, 3>, 4> corners_of_side{
    {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

struct TetrahedronSide {
    std::uint32_t tetrahedron = UINT32_MAX; ///< UINT32_MAX: there is none
    std::uint32_t side = 0;                 ///< 0 to 3

    [[nodiscard]] bool exists() const { return tetrahedron != UINT32_MAX; }
};

/// The tetrahedra on the two sides of a face.
struct FaceSides {
    TetrahedronSide front, back; ///< front: from where its corners appear counterclockwise
};

/// Per face of the mesh; by the numbers of vertices alone. Cost: O(n log n).
std::vector<FaceSides> sides_of_faces(const TetrahedralMesh& mesh);

} // namespace terrane
