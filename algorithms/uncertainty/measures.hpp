// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Measures of the blocks of a model: along vertical lines through the cells of a map, and above the depth of a
// contact.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

/// The cells of a map; their centres stand for them.
struct MapGrid {
    double x = 0, y = 0;               ///< least coordinates of its border
    double width = 1, height = 1;      ///< of a cell, unit of the mesh; > 0
    std::size_t columns = 1, rows = 1; ///< along x and along y
};

/// Blocks and heights along vertical lines through the centres of cells. Cells are counted along x,
/// then y.
struct ColumnMaps {
    std::vector<double>
        heights; ///< per surface and cell: z of the highest point of the surface; NaN: none
    std::vector<double>
        thicknesses; ///< per volume and cell: the length in the volume; [0], outside, is 0
};

/// Follows the vertical line through the centre of each cell. Which triangles it meets is exact: a line
/// through an edge or corner counts as moved a little to greater x, and less to greater y, so that it meets
/// one triangle of those round it; where it leaves the model so, to smaller x, or to smaller y. The order of what it
/// meets is exact. Vertical triangles are not met. Cost: linear in the triangles and in
/// the cells that their boxes cover.
ColumnMaps column_maps(const Mesh& mesh, const Volumes& volumes, const MapGrid& grid);

/// The part of a block above a contact, a level plane.
struct PartAbove {
    double volume = 0; ///< cubic unit
    double area = 0;   ///< of the block's section by the contact, squared unit
    double column = 0; ///< height of the highest point above the contact; 0: the block is below it
};

/// Measures of a block.
struct BlockMeasure {
    double low = 0, high = 0;       ///< least and greatest z
    Point3 middle{};                ///< centre of area of its boundary
    std::vector<PartAbove> above{}; ///< per contact
};

/// Measures each volume of a mesh; [0], the outside, is empty, as is one without triangles. `contacts`: z of each. In
/// floating point. Cost: linear.
std::vector<BlockMeasure> measure_blocks(const Mesh& mesh, const Volumes& volumes,
                                         std::span<const double> contacts);

} // namespace terrane
