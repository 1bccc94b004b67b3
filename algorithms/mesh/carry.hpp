// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Carries the values of surfaces to meshes that were made of them. A mesh has values per surface: on the
// vertices that triangles of the surface use, ascending, and on these triangles.
//
// The source of a triangle is the first of its parents in the surface; where a mesh has no parents, and for
// triangles that close a gap, it is the triangle nearest to its centre. The source of a vertex is the first of
// those of its triangles, or the triangle nearest to it.
// (1) A vertex at the place of a given one has the value of that, to the bit.
// (2) Other floating-point values are linear in the source and between those of its corners. There is none if a
//     corner that counts has none.
// (3) Integers and texts are those of the corner that counts most, the first among equals.
// (4) Values on triangles are those of the source.
// (5) Triangles that fill a hole have no values, nor have vertices that only they use.
// Cost: linear with parents, without them a search in a tree for each vertex and triangle.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Where the values of a mesh come from.
struct ValueSources {
    std::span<const Surface> given; ///< the surfaces that have values, as they were read, at their
                                    ///< places among those of the mesh; others may be empty.
                                    ///< Arrays of another length are passed over
    std::span<const Surface> parents; ///< the surfaces through which Mesh::parents_of counts. Where
                                      ///< one begins with the triangles of the given one, at their
                                      ///< places, the others are new; where not, all are new
    std::span<const std::size_t> filled{}; ///< per surface: its new triangles before this number
                                           ///< fill holes; none: all of them
};

/// Returns whether a surface has arrays.
bool have_values(std::span<const Surface> surfaces);

/// Returns the values per surface of the mesh; empty if no given surface has any.
std::vector<SurfaceValues> carry_values(const ValueSources& sources, const Mesh& mesh);

/// Does the same for the faces of tetrahedra that fill a mesh, whose vertices and faces take the place of vertices
/// and triangles.
std::vector<SurfaceValues> carry_values(const ValueSources& sources, const Mesh& mesh,
                                        const TetrahedralMesh& tetrahedra);

/// Returns the values of surfaces in concatenate(surfaces).
std::vector<SurfaceValues> values_of(std::span<const Surface> surfaces);

} // namespace terrane
