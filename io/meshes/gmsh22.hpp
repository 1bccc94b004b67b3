// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gmsh, MSH 2.2 in ASCII: what most other programs still read.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Surface i is physical surface i + 1 and elementary entity i + 1. An element of MSH 2.2 has one
/// physical group, so a triangle of several surfaces is there once for each of them, one after the
/// other; node v + 1 is vertex v. Numbers read back as the same doubles.
std::string to_msh22(const Mesh& mesh);

/// The same for faces; region r is physical volume and entity r + 1, called "outside" and
/// "region 1", ..., or "region 1: NAME" by region_names[1]. Elements: tetrahedra first, then
/// faces. Split nodes: as in MSH 4.1 (gmsh.hpp).
std::string to_msh22(const TetrahedralMesh& mesh, std::span<const std::string> region_names = {});

} // namespace terrane
