// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading Gmsh's MSH 2.2 and 4.1 (.msh).
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads the triangles and quadrilaterals of a file in text; quadrilaterals become two triangles.
/// - Each physical surface with elements becomes a surface, by increasing tag, with its name from
///   $PhysicalNames. An element of several physical surfaces is in each of them.
/// - Elements of no physical surface follow, one surface per entity: `name` if it is the only
/// surface of
///   the file, else "NAME entity TAG".
/// - $NodeData and $ElementData become values; one that has fewer than a 16th of the numbers is only named.
/// - Points, lines and volumes are passed over. A surface has only the vertices that it uses.
/// Errors: bad_syntax, bad_number, bad_index with "source:line"; unsupported (a binary file,
/// another version, triangles and quadrilaterals of higher order); nothing_to_do if there is no
/// triangle. Cost: n log n.
Result<std::vector<Surface>> read_msh(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Reads the tetrahedra of a file in text, of second order by their corners. Their labels are the tags of
/// physical volumes, or of entities. Errors: those of read_msh; nothing_to_do if there is none.
Result<LabelledTetrahedra> read_msh_tetrahedra(std::string_view contents, std::string_view source);

} // namespace terrane
