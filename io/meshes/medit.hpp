// SPDX-License-Identifier: LGPL-3.0-or-later
//
// MEDIT .mesh in ASCII, which INRIA's meshing programs and Mmg read.
#pragma once

#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Writes vertices and triangles in order. A triangle that belongs to surface s only has the
/// reference s + 1; each set of several surfaces has a larger reference of its own, so that no
/// triangle is written twice. Comments state the surfaces of each reference. Numbers read back as
/// the same doubles.
std::string to_medit(const Mesh& mesh);

/// Writes vertices, the faces on surfaces like the triangles above, and the tetrahedra, whose
/// reference is their block, 0 for the outside. If nodes are split, each side of a surface has a
/// reference of its own, and comments at the end list the pairs of vertices at the same point:
/// `# 12 345`, front and back.
std::string to_medit(const TetrahedralMesh& mesh);

} // namespace terrane
