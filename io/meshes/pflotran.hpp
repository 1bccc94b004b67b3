// SPDX-License-Identifier: LGPL-3.0-or-later
//
// PFLOTRAN: an implicit unstructured grid (.ugi) and the files of its regions.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/meshes/several_files.hpp>

namespace terrane {

/// Writes the tetrahedra, cell t + 1 with the vertices v + 1. Each block is a file STEM_NAME.txt with
/// its cells, and each side of a surface a file STEM_NAME.ss with its triangles, wound
/// counterclockwise seen from outside of their cells. Names are one word (names.hpp): that of the block,
/// or outside, region_1, ...; and that of the surface, with _front and _back where it has cells on
/// both sides. Numbers read back as the same doubles.
SeveralFiles to_pflotran(const TetrahedralMesh& mesh, std::string_view stem,
                         std::span<const std::string> block_names = {});

} // namespace terrane
