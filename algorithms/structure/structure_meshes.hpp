// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Extracts blocks and interfaces as separate meshes. They conform exactly: where two parts share a
// triangle, an edge or a vertex of the whole mesh, they have the same doubles there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A part of a mesh. It has the vertices used by its triangles, in their order, and no intersection
/// edges.
struct MeshPart {
    Mesh mesh;                            ///< the part as a mesh of its own
    std::vector<std::uint32_t> triangles; ///< per triangle of the part: its number in the whole
};

/// Which surfaces a part names.
enum class PartSurfaces : std::uint8_t {
    all, ///< those of the whole mesh, by their numbers there
    own, ///< those of its triangles, numbered anew in their order; the cost is that of the part
};

/// Extracts the closed boundary of a block (or of the outside, 0), oriented outward, without
/// interfaces that dangle in it.
MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    BlockId block, PartSurfaces surfaces = PartSurfaces::all);

/// Extracts an interface, oriented so that its front faces the volume of higher index; a dangling
/// one keeps the orientation of its triangles.
MeshPart interface_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                        InterfaceId interface, PartSurfaces surfaces = PartSurfaces::all);

/// Many parts as one mesh, one after the other. Parts share vertices; a triangle between two blocks
/// stands twice among all blocks.
struct MeshParts {
    MeshPart all;                       ///< it names all surfaces
    std::vector<std::uint32_t> part_of; ///< per triangle of `all`: number of its block or interface
};

/// Extracts all blocks but the outside, each as block_part() does.
MeshParts block_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure);
/// Extracts all interfaces, each as interface_part() does.
MeshParts interface_parts(const Mesh& mesh, const Volumes& volumes, const Structure& structure);

} // namespace terrane
