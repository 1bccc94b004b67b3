// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tetrahedra with nodes of their own on either side of some surfaces, as flow simulators and
// finite elements with slip on faults need them: those surfaces become cuts.
//
// (1) Two tetrahedra at a vertex of a split surface share the node there iff a chain of
//     tetrahedra, all at that vertex, leads from one to the other over faces that are not split.
//     So where the surface ends inside the model (a tip) the node stays one; where split surfaces
//     cross or branch each sector has its own.
// (2) Tetrahedra keep their order, volumes and regions. The first node at a vertex, that of the
//     lowest tetrahedron, keeps its number; the others follow after all vertices, by vertex, then
//     by lowest tetrahedron.
// (3) A split face becomes two: in front, at its place in the list, and behind, after all faces;
//     both wound alike. Their pairs are `twins` of the mesh. A face with all nodes common, between
//     tips, stays one, and so does one with a single tetrahedron, on the border of the domain.
// Cost: O(n log n).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// `surfaces`: indices into mesh.surfaces, those to split. The mesh must not be split already.
/// Errors: bad_index (no such surface), bad_option (already split), unsupported (more than
/// 2^30 tetrahedra, or no number left for a node).
Result<TetrahedralMesh> split_nodes(const TetrahedralMesh& mesh,
                                    std::span<const std::uint32_t> surfaces);

/// Two nodes at one place: in front of a split face and behind it.
using NodePair = std::array<std::uint32_t, 2>;

/// What to couple across each surface: the corners of twins on it, where they differ; sorted,
/// unique.
std::vector<std::vector<NodePair>> node_pairs(const TetrahedralMesh& mesh);

} // namespace terrane
