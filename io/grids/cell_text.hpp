// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids of cells as text: tables, and corner-point grids in Eclipse's keywords.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/io/grids/corner_point.hpp>

namespace terrane {

/// What files of a grid of cells call the blocks.
struct CellNames {
    std::vector<std::string> blocks; ///< per block of the model; [0]: the outside
    std::vector<std::string> units;  ///< per block: its unit, or empty
    std::string source{};            ///< of the model, for comments
    std::string length_unit{};       ///< of the model; empty: not stated
};

/// Writes a row per cell and block with volume in it, but for the outside: i, j, k from 1, with k upward; the centre of
/// the cell; number, name and unit of the block; its fraction of the cell; and 1 if the centre is in it, else 0.
std::string cells_to_csv(const RectilinearGrid& grid, const BlocksInCells& found,
                         const CellNames& names);

/// Returns the grid with vertical pillars; its layer 1 is the uppermost. A cell is active if its centre is in a block.
CornerPointGrid corner_points_of(const RectilinearGrid& grid, const BlocksInCells& found);

/// Returns SPECGRID, GRIDUNIT where the unit is m, ft or cm, COORD and ZCORN. `comment` says what
/// the grid is. Numbers are the shortest that read back as the same doubles.
std::string to_grdecl(const CornerPointGrid& grid, std::string_view comment);

/// Writes corner_points_of() with ACTNUM, FIPNUM, which is the number of the block of the centre, and MULTPV, which is
/// the part of the cell in blocks.
std::string cells_to_grdecl(const RectilinearGrid& grid, const BlocksInCells& found,
                            const CellNames& names);

} // namespace terrane
