// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// Removes the tetrahedra of block 0, the outside, with the faces and vertices that no block has
/// and the surface "box" that closed the domain. The rest keeps its order; blocks keep their
/// numbers, so that block 0 has no tetrahedra. Cost: linear.
TetrahedralMesh without_outside(TetrahedralMesh mesh);

} // namespace terrane
