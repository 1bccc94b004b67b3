// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading VTK XML PolyData (.vtp), the faces of an UnstructuredGrid (.vtu) and surfaces as StructuredGrid (.vts).
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Reads the polygons and triangle strips of all pieces; vertices and lines are passed over. Data
/// may be text, base64 or appended (raw or base64), of either byte order, as they are or compressed
/// by zlib, or by LZ4 and LZMA where their libraries were there when Terrane was built.
/// - Polygons are divided as append_face() does (algorithms/triangulation/face.hpp).
/// - A file that to_vtp() wrote gives its surfaces back: the field arrays surface_name and
/// surface_role
///   name them, and the cell array surface, or surfaces and surfaces_offset, tells which polygons
///   they have. Any other file becomes one surface, `name`.
/// - A surface has only the vertices that it uses, in file order.
/// Errors: bad_syntax, bad_number, bad_index with "source:line", the line of the element;
/// unsupported (another type of data, another compressor); nothing_to_do if there is no triangle.
/// Cost: linear in the size of the data, decompressed.
Result<std::vector<Surface>> read_vtp(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Reads the triangles, quadrilaterals, polygons, pixels and triangle strips of all pieces, as read_vtp
/// reads polygons; points, lines and volumes are passed over. A file that to_vtu() wrote gives the
/// faces of its tetrahedra on surfaces. Errors: those of read_vtp; unsupported for faces with curved
/// sides.
Result<std::vector<Surface>> read_vtu(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Reads the cells of a StructuredGrid with one point along i, j or k, without those that vtkGhostType hides. Errors:
/// those of read_vtp; unsupported for a volume.
Result<std::vector<Surface>> read_vts(std::string_view contents, std::string_view source,
                                      std::string_view name);

/// Reads the tetrahedra of all pieces, of second order by their corners, and their labels: the array `block`,
/// `cell_scalars`, `CellEntityIds` or `gmsh:physical`. Errors: those of read_vtu; nothing_to_do if there is none.
Result<LabelledTetrahedra> read_vtu_tetrahedra(std::string_view contents, std::string_view source);

} // namespace terrane
