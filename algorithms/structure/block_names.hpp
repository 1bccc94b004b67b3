// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Names of blocks: those that people gave, where there are any, and others by the surfaces that
// bound them.
//
// (a) The unit of a stratigraphic column. A block is of the unit whose base it lies on; one without
//     a base is of the unit below the lowest base above it. Where an erosive base is below a block,
//     older bases around it do not count. A block of several units, as one of their bases ends
//     inside of it or the block is on both sides of one, is called "first to last". A block below
//     the base of the lowest unit is "below UNIT".
// (b) The block that a file states (stated_blocks.hpp).
// (c) "below top, above base": the surfaces above and below it, without the boundary of the model;
//     "inside salt" and "around salt" for a surface that closes around the block, or in it; the
//     surfaces at its sides if there are no others: "west of F1".
// Blocks with the same name are told apart by surfaces at their sides, each time by the one at
// which most of them differ: "Unit A, west of F1". If that does not suffice, a number follows, in
// the order of the blocks: "Unit A, 2". All names are different, and one line long. They do not
// depend on the order of the surfaces if these have different names. Cost: linear, n log n in the
// blocks.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/structure/column.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// Names that people gave to blocks and units.
struct GivenNames {
    StratigraphicColumn column{};      ///< by surfaces of the mesh; empty: none
    std::vector<std::string> stated{}; ///< per block: the stated one it is; empty: none; or no list
    std::vector<std::string> layers{}; ///< per block: the layer of that one, as above
};

/// Names the blocks of a structure, and sets their units and ages. Surfaces of the column that the
/// mesh does not have are passed over; see check_column().
void name_blocks(const Mesh& mesh, const Volumes& volumes, const GivenNames& given,
                 Structure& structure);

} // namespace terrane
