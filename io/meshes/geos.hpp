// SPDX-License-Identifier: LGPL-3.0-or-later
//
// GEOS: a list of VTK XML files (.vtm) with the mesh and the fractures in it.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/io/meshes/opengeosys.hpp>
#include <terrane/io/meshes/several_files.hpp>

namespace terrane {

/// Writes the list of files, STEM_main.vtu, and STEM_NAME.vtu for each surface with split nodes. All
/// names are one word (names.hpp).
///   main  the block of that name: tetrahedra, then their faces on surfaces as triangles. The cell
///         array `attribute` (Int32) is the block of a tetrahedron, and of a triangle its surface,
///         counted from 1; triangles of several surfaces, and those on each side of a cut, have the
///         numbers after those, which a comment lists. Each surface has a point array NAME (Int64): 1
///         for its nodes, else 0; with split nodes NAME_front and NAME_back as well
///   NAME  the face block of a split surface: one triangle for two faces at one place. The point array
///         collocated_nodes has the nodes of `main` at a point, and -1 where there are fewer.
/// Points and cells have global ids; those of fractures are counted on from one to the next.
SeveralFiles to_geos(const TetrahedralMesh& mesh, const VtkFiles& files,
                     std::span<const std::string> block_names = {});

} // namespace terrane
