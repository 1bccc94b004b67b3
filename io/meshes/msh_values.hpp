// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Values in MSH files: $NodeData and $ElementData, alike in MSH 2.2 and 4.1.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Tells whether Gmsh has such values: they have 1, 3 or 9 components.
bool fits_msh(const ValueArray& array);

/// Returns the sections of values per surface, as from carry_values(), on triangles and on their vertices. Integers are
/// written in full, texts as indices. Nodes and elements without a value, and arrays that do not fit, are left out.
/// `is_22`: for MSH 2.2, in which a triangle is an element for each of its surfaces.
std::string to_msh_values(const Mesh& mesh, std::span<const SurfaceValues> values, bool is_22);
std::string to_msh_values(const TetrahedralMesh& mesh, std::span<const SurfaceValues> values,
                          bool is_22);

} // namespace terrane
