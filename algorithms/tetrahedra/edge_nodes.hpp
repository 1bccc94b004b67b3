// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra of second order: a node in the middle of each edge, which stays straight.
//
// (1) Tetrahedra with an edge in common have one node there, unless split surfaces part them round
//     this edge: those that faces connect, all at that edge, share a node, and others have their own.
//     So a cut stays a cut where both ends of an edge are nodes of both sides, as between two tips.
// (2) Tetrahedra that touch no cut at the edge share one node, also where blocks meet along the edge
//     alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/split_nodes.hpp>

namespace terrane {

/// The corners of each edge of a tetrahedron, in the order of VTK, Exodus II and Abaqus.
inline constexpr std::array<std::array<unsigned, 2>, 6> corners_of_edge{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// The nodes in the middle of edges of a mesh, numbered after its vertices by edge, then by lowest
/// tetrahedron.
struct EdgeNodes {
    std::vector<Point3> vertices; ///< those of the mesh, then the middles of edges: half the sum of
                                  ///< the two ends, rounded
    std::vector<std::array<std::uint32_t, 6>>
        of_tetrahedra; ///< per tetrahedron: the nodes on corners_of_edge
    std::vector<std::array<std::uint32_t, 3>>
        of_faces; ///< per face: between corners 0 and 1, 1 and 2, 2 and 0
};

/// Returns the nodes of second order. Errors: bad_index (a face of no tetrahedron), unsupported (no
/// number left for a node). Cost: O(n log n).
Result<EdgeNodes> find_edge_nodes(const TetrahedralMesh& mesh);

/// Returns node_pairs() with the nodes of second order.
std::vector<std::vector<NodePair>> node_pairs(const TetrahedralMesh& mesh, const EdgeNodes& nodes);

} // namespace terrane
