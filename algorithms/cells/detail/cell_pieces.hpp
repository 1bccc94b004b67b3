// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The parts of the triangles of a mesh in the cells of a grid.
#pragma once

#include <cstdint>
#include <vector>

#include <terrane/algorithms/cells/detail/triangle_part.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/kernel/double_double.hpp>

namespace terrane::cells::detail {

/// A part of a triangle in a cell, or above the grid.
struct CellPiece {
    std::uint64_t place = 0;    ///< see PlacesOfPieces
    std::uint32_t triangle = 0; ///< of the mesh
    bool divides =
        false; ///< whether it meets the open cell; otherwise it is in the bottom of the cell, or above the grid
    PartMoments<DoubleDouble> moments{}; ///< without moment above the grid; 0 if it is vertical
};

/// Numbers of places: of one column of cells after the other, each from above the grid downward.
struct PlacesOfPieces {
    std::uint64_t nx, ny, nz;

    explicit PlacesOfPieces(const RectilinearGrid& grid) :
        nx(grid.x.size() - 1), ny(grid.y.size() - 1), nz(grid.z.size() - 1) {}

    /// Returns the place of layer k of a column; k = nz: above the grid.
    [[nodiscard]] std::uint64_t of(std::uint64_t column, std::uint64_t k) const {
        return column * (nz + 1) + (nz - k);
    }
    [[nodiscard]] std::uint64_t column_of(std::uint64_t place) const { return place / (nz + 1); }
    [[nodiscard]] std::uint64_t layer_of(std::uint64_t place) const {
        return nz - place % (nz + 1);
    }
};

/// Returns the corners of a triangle of a mesh.
std::array<Point3, 3> corners_in(const Mesh& mesh, std::uint32_t triangle);

/// Returns the pieces of all triangles that do not dangle, by place and triangle.
std::vector<CellPiece> find_pieces(const Mesh& mesh, const Volumes& volumes,
                                   const RectilinearGrid& grid, const Run& run);

/// Returns the box of the cell at a place; above the grid, that of the cell below.
CellBox box_at(const RectilinearGrid& grid, std::uint64_t place);

/// Returns the part of a triangle in a cell. Precondition: the triangle has a piece there.
TrianglePart part_at(const CutTriangle& triangle, const RectilinearGrid& grid, std::uint64_t place);

} // namespace terrane::cells::detail
