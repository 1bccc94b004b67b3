// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Prisms between two surfaces as meshes of other programs.
#pragma once

#include <cstdint>
#include <string>

#include <terrane/algorithms/cells/prisms.hpp>

namespace terrane {

/// Returns an UnstructuredGrid of VTK's XML format (.vtu): wedges, pyramids and tetrahedra. The cell arrays (Int32) are
/// layer, from 1 at the top, and triangle, of the top, from 0.
std::string to_vtu(const PrismMesh& mesh);

/// Returns Gmsh's format 2.2 as text: prisms, pyramids and tetrahedra. Physical volumes are the layers, "layer 1" at
/// the top.
std::string to_msh22(const PrismMesh& mesh);

} // namespace terrane
