// SPDX-License-Identifier: LGPL-3.0-or-later
//
// VTK XML: PolyData (.vtp) and UnstructuredGrid (.vtu). The data are inline base64, little endian,
// with 64-bit headers, which VTK reads since version 6.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>
#include <terrane/io/meshes/cell_array.hpp>

namespace terrane {

/// Writes the triangles as polygons, in order. The cell arrays (Int32) are
///   surface        index of the first surface of the triangle
///   surface_count  number of its surfaces (> 1: they coincide there)
///   region         its region in that first surface, if the mesh has regions
///   parent         its first input triangle, if the mesh has parents
/// followed by `cells`. The field arrays are surface_name and surface_role (strings, one per
/// surface) and, if some triangle has several surfaces, surfaces and surfaces_offset (Int64):
/// triangle i belongs to surfaces[surfaces_offset[i] .. surfaces_offset[i + 1]).
/// If there are `block_names`, they are the field array block_name (strings).
/// `values` per surface, as from carry_values(), are further arrays of points and cells in their types; texts are
/// strings. The field arrays value_name, value_unit (strings) and value_no_data (Float64, NaN: none) describe them,
/// those of points first.
/// Errors: bad_option if an array of `cells` does not have one value per triangle.
Result<std::string> to_vtp(const Mesh& mesh, bool compress = true,
                           std::span<const CellArray> cells = {},
                           std::span<const std::string> block_names = {},
                           std::span<const SurfaceValues> values = {});

/// Writes the tetrahedra, then their faces on surfaces as triangles. The cell arrays (Int32) are
///   block    of the tetrahedron; -1 for a face
///   surface  index of the first surface of the face; -1 for a tetrahedron
///   surface_count  number of its surfaces; 0 for a tetrahedron
///   parent   triangle of the mesh that contains the face; -1 for none and for a tetrahedron
///   twin     if nodes are split: the cell on the other side of the cut, with its corners in the
///            same order; -1 for any other cell
///   cut_side 1 in front of the cut, 2 behind it, 0 for any other cell
/// followed by `cells`. The field arrays are those of to_vtp; their lists count faces only. Names
/// and roles are arrays of character codes (UInt8), each string ended by a 0: meshio refuses grids
/// with arrays of strings. If there are `block_names`, one per block, they are the field array
/// block_name, of codes as well. With `nodes` the cells are of second order: quadratic tetrahedra
/// and triangles. `values` are written as by to_vtp, but texts as their indices; tetrahedra and vertices that are on
/// no surface have none. Errors: bad_option if an array of `cells` does not have one value per tetrahedron
/// and face.
Result<std::string> to_vtu(const TetrahedralMesh& mesh, bool compress = true,
                           std::span<const CellArray> cells = {},
                           std::span<const std::string> block_names = {},
                           const EdgeNodes* nodes = nullptr,
                           std::span<const SurfaceValues> values = {});

} // namespace terrane
