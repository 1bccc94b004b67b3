// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gmsh, MSH 4.1 in ASCII.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Surface i is physical surface i + 1 and entity i + 1 of dimension 2. Triangles of several
/// surfaces are in entities of their own, after those, with all physical tags. Element t + 1 is
/// triangle t, node v + 1 is vertex v. Numbers read back as the same doubles.
std::string to_msh(const Mesh& mesh);

/// The same for faces; region r is volume entity r + 1 and physical volume r + 1, called "outside"
/// and "region 1", ..., or "region 1: NAME" by region_names[1]. Elements: tetrahedra first, then
/// faces. Where nodes are split, the faces of surface s in front of the cut are not in s + 1 but in
/// a physical surface of their own, "NAME front", those behind it in "NAME back", and $Periodic
/// lists the nodes at one place.
std::string to_msh(const TetrahedralMesh& mesh, std::span<const std::string> region_names = {});

} // namespace terrane
