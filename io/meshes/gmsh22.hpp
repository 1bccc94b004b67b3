// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gmsh, MSH 2.2 in ASCII, the version that most other programs still read.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

namespace terrane {

/// Writes the triangles: node v + 1 is vertex v; surface i is physical surface i + 1 and elementary
/// entity i + 1. An element of MSH 2.2 has one physical group, so a triangle of several surfaces is
/// written once for each of them, one after the other. Numbers read back as the same doubles.
std::string to_msh22(const Mesh& mesh);

/// Writes the tetrahedra, then their faces on surfaces, numbered as the triangles above. Block r
/// is physical volume and entity 3 n + r + 1, with n surfaces, with the name "outside" or "block
/// 1", ..., or "block 1: NAME" if block_names[1] is NAME. Split nodes are written as in MSH 4.1
/// (gmsh.hpp), and so are elements of second order.
std::string to_msh22(const TetrahedralMesh& mesh, std::span<const std::string> block_names = {},
                     const EdgeNodes* edge_nodes = nullptr);

} // namespace terrane
