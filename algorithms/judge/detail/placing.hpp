// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Which cell each triangle of a mesh is in, and which way it faces there.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/judge/detail/crowding.hpp>
#include <terrane/algorithms/judge/detail/matching.hpp>
#include <terrane/algorithms/judge/detail/separation.hpp>
#include <terrane/algorithms/judge/detail/target.hpp>

namespace terrane::judging {

/// Where the triangles of a mesh are.
struct Placing {
    std::vector<std::uint32_t> cell_of; ///< per triangle: its cell, or no_index
    std::vector<int> facing;            ///< per triangle: 1 if it is wound as its cell, else -1
    std::vector<std::uint32_t> unsure;  ///< triangles that may be in another cell, or near theirs
    std::vector<std::uint32_t> off; ///< triangles with a corner that is farther from the plane of
                                    ///< their cell than the bound; they are in no cell
};

/// Places the triangles.
Placing place(const Target& target, const Cells& cells, const Crowding& crowding,
              const OutputMesh& output, const Matching& matching, const Separation& separation,
              double bound);

} // namespace terrane::judging
