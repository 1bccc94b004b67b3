// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Numbers a mesh by place, so that remeshing does not depend on the order of files.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane::quality::detail {

/// A mesh whose numbering follows from the places of its vertices.
struct SortedMesh {
    Mesh mesh; ///< vertices along a space-filling curve; corners of triangles ascend, which drops
               ///< their orientation; triangles by their corners. No parents
    std::vector<std::uint32_t> number_of;   ///< per vertex of the given mesh: its number here
    std::vector<std::uint32_t> triangle_of; ///< per triangle: its number in the given mesh
};

/// Sorts vertices by the Morton code of their place in the box of all (ties by the coordinates),
/// and triangles by their corners. No two vertices may have equal coordinates. Cost: that of
/// sorting.
SortedMesh sort_by_place(const Mesh& mesh);

} // namespace terrane::quality::detail
