// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The claims of a certificate about blocks, and about tetrahedra that fill them. Triangles are
// those of the mesh of doubles. A side is a number: 2 t is the front of triangle t, from which its
// corners are counterclockwise, 2 t + 1 is its back.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// The claims about blocks. Number 0 is the outside.
struct BlocksClaim {
    std::uint32_t exact = 0; ///< number of blocks of the exact arrangement, which have the numbers
                             ///< from 1 on; blocks that rounding made follow
    IndexLists<std::uint32_t> shells; ///< per shell: its sides, ascending; by their first sides
    std::vector<std::uint32_t> block_of_shell; ///< per shell: the block that it bounds
    std::vector<std::uint32_t> around; ///< per shell: UINT32_MAX if it bounds its block from the
                                       ///< outside, or bounds the outside; else the shell that
                                       ///< bounds its block from the outside
    std::vector<std::string> volumes;  ///< per block: its exact volume in the mesh of doubles, as a
                                       ///< reduced fraction; [0] is that of all blocks
};

/// The claims about tetrahedra.
struct TetrahedraClaim {
    bool box = false;             ///< they fill a box around the mesh, with the outside
    std::vector<Point3> vertices; ///< called nodes; unit of the input
    std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< the fourth node is in front of the
                                                          ///< triangle of the first three
    std::vector<std::uint32_t> block_of;                  ///< per tetrahedron
    std::vector<Triangle> faces;                          ///< those on triangles, and on the box
    std::vector<std::uint32_t> triangle_of; ///< per face: the triangle that it is on; UINT32_MAX
                                            ///< on the box
    std::vector<std::array<std::uint32_t, 2>> twins; ///< pairs of faces, in front of a cut and
                                                     ///< behind it, corner by corner at the same
                                                     ///< place
};

} // namespace terrane
