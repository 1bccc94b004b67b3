// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Cells of second order: their corners, then their nodes on edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

namespace terrane::detail {

/// The order in which a format lists the nodes on edges: indices into corners_of_edge.
using EdgeOrder = std::array<unsigned, 6>;

/// Gmsh has the edges 01, 12, 20, 03, 23, 13 (reference manual, "Node ordering").
inline constexpr EdgeOrder order_of_gmsh{0, 1, 2, 3, 5, 4};
/// Abaqus (C3D10), VTK and Exodus II have 01, 12, 20, 03, 13, 23.
inline constexpr EdgeOrder order_of_abaqus{0, 1, 2, 3, 4, 5};

inline std::vector<std::array<std::uint32_t, 10>>
tetrahedra_of_10(const TetrahedralMesh& mesh, const EdgeNodes& nodes, const EdgeOrder& order) {
    std::vector<std::array<std::uint32_t, 10>> cells(mesh.tetrahedra.size());
    for (std::size_t t = 0; t < cells.size(); ++t) {
        for (std::size_t k = 0; k < 4; ++k) cells[t][k] = mesh.tetrahedra[t][k];
        for (std::size_t e = 0; e < 6; ++e) cells[t][4 + e] = nodes.of_tetrahedra[t][order[e]];
    }
    return cells;
}

inline std::vector<std::array<std::uint32_t, 6>> triangles_of_6(const TetrahedralMesh& mesh,
                                                                const EdgeNodes& nodes) {
    std::vector<std::array<std::uint32_t, 6>> cells(mesh.faces.size());
    for (std::size_t f = 0; f < cells.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            cells[f][k] = mesh.faces[f][k];
            cells[f][3 + k] = nodes.of_faces[f][k];
        }
    return cells;
}

} // namespace terrane::detail
