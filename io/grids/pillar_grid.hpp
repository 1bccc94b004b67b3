// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Corner-point grids of horizons, on vertical pillars.
//
// (1) Pillars stand where lines across x and y cross. Each column of cells has a node on each horizon at each of its
//     four pillars. Which triangle of the horizon is there is decided exactly, as seen from the column: where a
//     vertical fault runs through a pillar, columns on both sides have nodes in different heights. The height is the
//     double nearest to the exact one.
// (2) Between two horizons layers divide each pillar evenly.
// (3) Cells are not active where a horizon is missing at one of the column's pillars, where a horizon is below the next
//     one at one of them, and where they have no thickness at all four.
// Cost: linear in the cells, and in the triangles whose boxes in the map contain a pillar.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/grids/corner_point.hpp>

namespace terrane {

/// Where pillars stand, and how many layers there are.
struct PillarOptions {
    std::vector<double> x; ///< of lines across x, ascending, >= 2
    std::vector<double> y; ///< of lines across y, ascending, >= 2
    std::vector<std::uint32_t>
        layers; ///< between a horizon and the next, >= 1; a single number: of all
};

/// Why cells of a column are not active.
struct PillarGap {
    std::uint32_t i = 0, j = 0; ///< the column
    std::uint32_t horizon = 0;  ///< the first that is missing, or that is below the next one
    bool is_crossed = false;    ///< the horizon is below the next one; otherwise it is missing
};

/// A grid of horizons.
struct PillarGrid {
    CornerPointGrid grid;             ///< with `active`
    std::vector<std::uint32_t> units; ///< per layer: the number of the horizon above it, from 1
    std::vector<PillarGap> gaps;      ///< by column
    std::size_t active = 0;           ///< cells
};

/// Makes a corner-point grid of horizons from the top down.
/// Errors: bad_option for fewer than two horizons, lines or layers that make no grid, a horizon that folds over, and
/// more than 10^8 cells; nothing_to_do if no cell is active; those of validate(); interrupted.
Result<PillarGrid> make_pillar_grid(std::span<const Surface> horizons, const PillarOptions& options,
                                    const Run& run = {});

/// Writes the grid in Eclipse's keywords: those of to_grdecl(), ACTNUM and FIPNUM, which is the unit.
std::string to_grdecl(const PillarGrid& made, std::span<const Surface> horizons);

} // namespace terrane
