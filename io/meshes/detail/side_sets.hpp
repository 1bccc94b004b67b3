// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The parts of tetrahedral meshes as simulators name them: blocks of elements, and sets of element
// faces on the sides of surfaces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/mesh/face_sides.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>
#include <terrane/io/meshes/detail/groups.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane::detail {

/// The tetrahedra of a block.
struct ElementBlock {
    std::uint32_t block = 0;
    std::size_t number = 0; ///< that of the block; the outside, 0, has the number after all others
    std::string name;       ///< one word, after the block; see WordNames
    std::vector<std::uint32_t> tetrahedra; ///< ascending
};

/// The element faces on one side of a surface.
struct SideSet {
    std::uint32_t surface = 0;
    CutSide side = CutSide::none;       ///< none: the surface has tetrahedra on one side only
    std::size_t tag = 0;                ///< see side_tag
    std::string name;                   ///< one word: NAME, NAME_front or NAME_back
    std::vector<TetrahedronSide> sides; ///< by face
    std::vector<std::uint32_t> faces;   ///< parallel: faces of the mesh
};

/// All parts, with names that differ from each other even in other capital letters.
struct NamedParts {
    std::vector<std::string> surfaces; ///< one word per surface
    std::vector<SideSet> side_sets;    ///< by surface, front first; none is empty
    std::vector<ElementBlock> blocks;  ///< by block; none is empty
    WordNames names;                   ///< to name further parts
};

[[nodiscard]] NamedParts named_parts(const TetrahedralMesh& mesh,
                                     std::span<const std::string> block_names);

/// Returns the nodes of a face: its corners, and with `nodes` those on its edges.
[[nodiscard]] std::vector<std::uint32_t> nodes_of_face(const TetrahedralMesh& mesh,
                                                       const EdgeNodes* nodes, std::size_t face);

/// Returns the nodes of an element face, counterclockwise seen from outside of its tetrahedron;
/// with `nodes` those on its edges follow, of which the first is between the first two corners.
[[nodiscard]] std::vector<std::uint32_t>
outward_nodes(const TetrahedralMesh& mesh, const EdgeNodes* nodes, const TetrahedronSide& side);

/// Returns all nodes on faces; sorted, unique.
[[nodiscard]] std::vector<std::uint32_t> nodes_of_faces(const TetrahedralMesh& mesh,
                                                        const EdgeNodes* nodes,
                                                        std::span<const std::uint32_t> faces);

/// Returns the faces of each surface, ascending.
[[nodiscard]] std::vector<std::vector<std::uint32_t>>
faces_of_surfaces(const TetrahedralMesh& mesh);

/// Returns, for each surface, the edges at which it ends inside the domain: those of only one of its
/// faces that are not on the border of the domain. Twins count as one face. Sorted, unique.
[[nodiscard]] std::vector<std::vector<Edge>> buried_edges(const TetrahedralMesh& mesh);

} // namespace terrane::detail
