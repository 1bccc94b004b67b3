// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writing points and lines of a mesh for GOCAD: VSet (.vs) and PLine (.pl).
#pragma once

#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Returns a VSet per surface with the vertices that it uses, in the order of the mesh; surfaces
/// without triangles are left out. z points up, and numbers read back as the same doubles. Defined in
/// detail/write_curves.cpp, as is the following.
std::string to_vset(const Mesh& mesh);

/// Returns a PLine "NAME border" per surface with a free border, the edges that one of its triangles
/// has, and one per set of surfaces with common intersection edges of the mesh, called after them:
/// "top and F1". Edges are joined to lines (ILINE) up to vertices at which other than two of them
/// meet; a closed line ends with a SEG to its first vertex. Errors: nothing_to_do if there is no line;
/// the place is empty.
Result<std::string> to_plines(const Mesh& mesh);

} // namespace terrane
