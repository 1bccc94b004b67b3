// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks in the cells of a rectilinear grid.
//
// (1) The block of a centre is decided exactly, as locate_points() decides it.
// (2) A block has a share in a cell if and only if it has volume there. That is decided exactly.
// (3) Each fraction is the double nearest to the exact volume of the block within the cell, divided by that of the
//     cell. So the fractions of a cell add up to 1, and those of a block to its volume, but for that rounding.
// (4) It is checked that the fractions of each block add up to its volume in the grid as a whole, which is computed
//     from the triangles once more, and where the grid contains the mesh, to its measure.
//
// Each triangle is cut by the planes of the grid, without an epsilon: a corner of a part is named by the edges and
// planes that meet there, and predicates tell on which side of a plane it is. Along a vertical, the length of a block
// within a cell is the height of the cell for each triangle above it that has the block below, less that for each that
// has it above, and likewise the height of a triangle within the cell. Integrated over the cell in the map, these are
// the areas and moments of parts of triangles. They are summed with about 106 bits and an error bound, from the nearest
// cell above that no triangle divides; where this does not decide the rounding, rationals do.
// Cost: that of sorting the parts of triangles in cells, and of locating a point in each divided cell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A rectilinear grid of cells, by the planes between them. Cell (i, j, k) is at (k ny + j) nx + i.
struct CellGrid {
    std::vector<double> x; ///< ascending, each once, >= 2; unit of the mesh
    std::vector<double> y; ///< likewise
    std::vector<double> z; ///< likewise

    /// Returns the number of cells along x, y and z. Precondition: each axis has a plane.
    [[nodiscard]] std::array<std::size_t, 3> counts() const {
        return {x.size() - 1, y.size() - 1, z.size() - 1};
    }
    /// Returns the number of all cells.
    [[nodiscard]] std::size_t size() const {
        const auto [nx, ny, nz] = counts();
        return nx * ny * nz;
    }
    /// Returns the middle of a cell, each coordinate rounded once.
    [[nodiscard]] Point3 centre(std::size_t cell) const;
};

/// Returns the cells whose planes are at multiples of these steps along x, y and z, as few as contain the mesh.
/// Errors: bad_option for a step that is not positive or too small for the coordinates, and for more than 10^9 cells;
/// nothing_to_do for a mesh without triangles.
Result<CellGrid> cells_with_steps(const Mesh& mesh, const std::array<double, 3>& steps);

/// Returns these numbers of cells along x, y and z, of one size but for rounding, that fill the least box around the
/// mesh.
/// Errors: bad_option for a number of 0, cells thinner than doubles can tell, and more than 10^9 cells; nothing_to_do
/// for a mesh without triangles.
Result<CellGrid> cells_by_count(const Mesh& mesh, const std::array<std::uint32_t, 3>& counts);

/// The part of a cell that a block fills.
struct BlockShare {
    BlockId block{};     ///< 0: the outside
    double fraction = 0; ///< of the cell, > 0
};

/// The blocks in the cells of a grid.
struct BlocksInCells {
    std::vector<BlockId> block_of; ///< per cell: the block that contains its centre; 0: the outside
    std::vector<std::size_t>
        first; ///< per cell its first share, and one more: the number of shares
    std::vector<BlockShare> shares; ///< of one cell after the other, by block
    std::vector<double> fractions;  ///< per block: the part of the whole grid that it fills

    /// Returns the part of a cell that a block fills.
    [[nodiscard]] double fraction(std::size_t cell, BlockId block) const;
};

/// Finds the blocks in the cells of a grid. The mesh is conforming, and has these volumes.
/// Errors: bad_option for a grid without cells, planes that are not ascending or finite, and more than 10^9 cells;
/// interrupted; out_of_memory; internal if the mesh is not conforming, or the volumes are not its.
Result<BlocksInCells> blocks_in_cells(const Mesh& mesh, const Volumes& volumes,
                                      const CellGrid& grid, const Run& run = {});

} // namespace terrane
