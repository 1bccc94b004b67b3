// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gmsh, MSH 4.1 in ASCII.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

namespace terrane {

/// Writes the triangles: node v + 1 is vertex v, element t + 1 is triangle t. Surface i is physical
/// surface i + 1 and entity i + 1 of dimension 2. Triangles that belong to several surfaces are in
/// further entities, which have the physical tags of all these surfaces. Numbers read back as the
/// same doubles.
std::string to_msh(const Mesh& mesh);

/// Writes the tetrahedra, then their faces on surfaces, which have entities and physical surfaces
/// as the triangles above. Block r is volume entity r + 1 and, with n surfaces, physical volume 3
/// n + r + 1, which is no number of a physical surface, with the name "outside" or "block 1", ...,
/// or "block 1: NAME" if block_names[1] is NAME. If nodes are split, the faces of surface s in
/// front of the cut are in the physical surface "NAME front" and those behind it in "NAME back",
/// instead of in s + 1; $Periodic lists the pairs of nodes at the same point. With `nodes` the
/// elements are of second order (types 11 and 9).
std::string to_msh(const TetrahedralMesh& mesh, std::span<const std::string> block_names = {},
                   const EdgeNodes* nodes = nullptr);

} // namespace terrane
