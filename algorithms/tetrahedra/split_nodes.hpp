// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Duplicates the nodes on some surfaces, so that the tetrahedra on their two sides are separate, as
// flow simulators and finite elements with slip on faults need it: these surfaces become cuts.
//
// (1) Two tetrahedra at a vertex of a split surface share the node there iff a chain of
//     tetrahedra, all at that vertex, connects them across faces that are not split. So a single
//     node remains where the surface ends inside the model (at a tip); where split surfaces cross
//     or branch, each sector has its own node.
// (2) Tetrahedra keep their order, volumes and blocks. The first node at a vertex, that of the
//     lowest tetrahedron, keeps its number; the others follow after all vertices, by vertex, then
//     by lowest tetrahedron.
// (3) A split face becomes two faces: the one in front keeps its position in the list, the one
//     behind follows after all faces; both have the same winding. The pairs are the `twins` of the
//     mesh. A face between tips, all of whose nodes are shared, stays single, and so does a face
//     with only one tetrahedron, on the border of the domain.
// Cost: O(n log n).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Splits the nodes on `surfaces`, given as indices into mesh.surfaces. No nodes of the mesh may be
/// split already.
/// Errors: bad_index (no such surface), bad_option (already split), unsupported (more than
/// 2^30 tetrahedra, or no number left for a node).
Result<TetrahedralMesh> split_nodes(const TetrahedralMesh& mesh,
                                    std::span<const std::uint32_t> surfaces);

/// Two nodes at the same point: in front of a split face and behind it.
using NodePair = std::array<std::uint32_t, 2>;

/// Returns, for each surface, the pairs of nodes to couple across it: the corners of its twins,
/// where these differ; sorted, unique.
std::vector<std::vector<NodePair>> node_pairs(const TetrahedralMesh& mesh);

} // namespace terrane
