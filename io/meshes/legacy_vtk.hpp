// SPDX-License-Identifier: LGPL-3.0-or-later
//
// VTK's legacy format (.vtk).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads POLYDATA and UNSTRUCTURED_GRID, text or binary, of versions 1 to 5. The polygons and triangle
/// strips of POLYDATA, and the triangles, quadrilaterals, polygons, pixels and triangle strips of a
/// grid, become one surface, `name`; points, lines and volumes are passed over.
/// - A file that to_vtk() wrote gives its surfaces back, with names and roles; so does a file of VTK
///   with the arrays of to_vtp() or to_vtu(). Other arrays of points and cells become values of surfaces.
/// - Polygons are divided as append_face() does (algorithms/triangulation/face.hpp). A surface has
///   only the vertices that it uses.
/// Errors: bad_syntax, bad_number, bad_index with "source:line", or "source, byte n" where the data
/// are binary; unsupported (another DATASET, cells with curved sides); nothing_to_do if there is no
/// triangle. Cost: linear.
Result<std::vector<Surface>> read_vtk(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Reads the tetrahedra of an UNSTRUCTURED_GRID, of second order by their corners, with the labels that
/// read_vtu_tetrahedra() reads. Errors: those of read_vtk; nothing_to_do if there is none.
Result<LabelledTetrahedra> read_vtk_tetrahedra(std::string_view contents, std::string_view source);

/// Writes the triangles as POLYDATA in text, version 3.0. The cell array `surface` (int) is the number
/// of the first surface of each triangle, `surface_count` the number of its surfaces. Field arrays:
/// surface_name and surface_role (unsigned_char), the codes of the characters of all names and roles,
/// each ended by a 0; surfaces_offset and surfaces (int): triangle i belongs to
/// surfaces[surfaces_offset[i] .. surfaces_offset[i + 1]). Numbers read back as the same doubles.
/// `values` per surface, as from carry_values(), follow as fields of cells and points, with the field arrays
/// value_name, value_unit and value_no_data. Defined in legacy_vtk_writer.cpp.
std::string to_vtk(const Mesh& mesh, std::span<const SurfaceValues> values = {});

} // namespace terrane
