// SPDX-License-Identifier: LGPL-3.0-or-later
//
// MEDIT .mesh in ASCII, as INRIA's meshing programs and Mmg read it.
#pragma once

#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Vertices and triangles in their order. The reference of a triangle of surface s alone is s + 1;
/// sets of several surfaces have references after those, so that no triangle is there twice.
/// Comments say which surfaces a reference stands for. Numbers read back as the same doubles.
std::string to_medit(const Mesh& mesh);

/// The same for faces, then the tetrahedra: their reference is their region, 0 for the outside.
/// Where nodes are split each side of a surface has a reference of its own, and comments at the end
/// say which vertices are at one place: `# 12 345`, front and back.
std::string to_medit(const TetrahedralMesh& mesh);

} // namespace terrane
