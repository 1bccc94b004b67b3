// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids as ImageData (.vti) and RectilinearGrid (.vtr) of VTK's XML format.
#pragma once

#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/cell_text.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Returns the grid as an image at z = 0, whose only array has its name and its values, NaN where there is none.
/// A rotation is its Direction, which VTK reads since version 9. Errors: those of to_esri().
Result<std::string> to_vti(const Grid& grid);

/// Returns the cells of a grid and their blocks. The cell arrays are
///   block     number of the block of the centre (UInt32); 0: the outside
///   unit      index of the unit of that block (Int32); -1: none
///   fraction  part of the cell that this block fills (Float64)
/// The field arrays block_name and unit_name are character codes (UInt8), each string ended by a 0. share_cell (Int64),
/// share_block (UInt32) and share_fraction (Float64) list all blocks in the cells that several blocks share.
/// Errors: unsupported if the planes across an axis are not equally far apart, but for rounding; .vtr has such.
Result<std::string> to_vti(const RectilinearGrid& grid, const BlocksInCells& found,
                           const CellNames& names);
/// The same with any planes.
std::string to_vtr(const RectilinearGrid& grid, const BlocksInCells& found, const CellNames& names);

} // namespace terrane
