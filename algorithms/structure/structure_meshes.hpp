// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Blocks and interfaces as meshes of their own. Neighbours conform exactly: where two parts share a
// triangle, an edge or a vertex of the whole, they have the same doubles there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// A part of a mesh. It has all its surfaces, the vertices that its triangles use, in their order,
/// and no intersection edges.
struct MeshPart {
    Mesh mesh;                            ///< the part as a mesh of its own
    std::vector<std::uint32_t> triangles; ///< per triangle of the part: its number in the whole
};

/// The closed boundary of a block (or of the outside, 0), wound outward, without what dangles in
/// it.
MeshPart block_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                    std::uint32_t block);

/// An interface, wound so that its front faces the volume of higher number; where it dangles, as it
/// comes.
MeshPart interface_part(const Mesh& mesh, const Volumes& volumes, const Structure& structure,
                        std::uint32_t interface);

} // namespace terrane
