// SPDX-License-Identifier: LGPL-3.0-or-later
//
// VTK XML: PolyData (.vtp) and UnstructuredGrid (.vtu). Inline base64, little endian, 64-bit
// headers: any VTK since 6 reads it.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/meshes/cell_array.hpp>

namespace terrane {

/// The triangles as polygons, in order. Cell arrays, Int32:
///   surface        index of the first surface of the triangle
///   surface_count  number of its surfaces (> 1: they coincide there)
///   region         its region in that first surface, where the mesh has regions
///   parent         its first input triangle, where the mesh has parents
/// and `cells`. Field arrays: surface_name, surface_role (strings, one per surface) and, where some
/// triangle has several surfaces, surfaces and surfaces_offset (Int64): triangle i belongs to
/// surfaces[surfaces_offset[i] .. surfaces_offset[i + 1]).
/// Errors: bad_option where an array of `cells` has not one value per triangle.
Result<std::string> to_vtp(const Mesh& mesh, bool compress = true,
                           std::span<const CellArray> cells = {});

/// The tetrahedra, then their faces on surfaces as triangles. Cell arrays, Int32:
///   region   of the tetrahedron; -1 for a face
///   surface  index of the first surface of the face; -1 for a tetrahedron
///   surface_count  number of its surfaces; 0 for a tetrahedron
///   parent   triangle of the mesh that the face is part of; -1 for none and for a tetrahedron
///   twin     where nodes are split: the cell on the other side of the cut, its corners in the same
///            order; -1 for any other cell
///   cut_side 1 in front of the cut, 2 behind it, 0 for any other cell
/// and `cells`. Field arrays as above; the lists count faces only.
/// Errors: bad_option where an array of `cells` has not one value per tetrahedron and face.
Result<std::string> to_vtu(const TetrahedralMesh& mesh, bool compress = true,
                           std::span<const CellArray> cells = {});

} // namespace terrane
