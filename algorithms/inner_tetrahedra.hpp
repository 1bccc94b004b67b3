// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/mesh.hpp>

namespace terrane {

/// The blocks alone: without the tetrahedra of region 0 between the surfaces and the box, the
/// faces that none of the others has, and the surface "box". Vertices that are left, tetrahedra
/// and faces keep their order, regions their numbers. Precondition: nodes are not split.
/// Cost: O(n log n).
TetrahedralMesh inner_tetrahedra(const TetrahedralMesh& mesh);

} // namespace terrane
