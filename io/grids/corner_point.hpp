// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Corner-point grids of reservoir simulators, and their conversion to surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// A face between two columns of cells that a file counts to a fault. Face i of the first kind is
/// between columns i - 1 and i of the same row, of the second kind between rows j - 1 and j.
struct NamedFace {
    std::uint32_t i = 0, j = 0; ///< of the column behind the face
    bool across_i = true;       ///< the face is between two columns of one row
    std::uint32_t fault = 0;    ///< index into CornerPointGrid::faults
};

/// Cells whose corners lie on pillars. Column (i, j) stands between the pillars (i, j), (i + 1, j),
/// (i, j + 1) and (i + 1, j + 1); its cell 0 is the uppermost. Depths are positive down.
struct CornerPointGrid {
    std::uint32_t nx = 0; ///< columns along i, >= 1
    std::uint32_t ny = 0; ///< rows along j, >= 1
    std::uint32_t nz = 0; ///< layers, >= 1
    /// Two points of each pillar: x, y, depth, x, y, depth; pillar (i, j) at j (nx + 1) + i; finite
    std::vector<std::array<double, 6>> pillars;
    /// Depths of the corners: that of cell (i, j, k) on pillar (i + a, j + b), at its top for c = 0
    /// and at its base for c = 1, is at ((2k + c) 2ny + 2j + b) 2nx + 2i + a; finite
    std::vector<double> depths;
    std::vector<char> active;        ///< of each cell, at (k ny + j) nx + i; empty: all are active
    std::vector<std::string> faults; ///< names of faults in the file, in its order
    std::vector<NamedFace> faces;    ///< of the faults
    CoordinateFrame frame{};         ///< what the file states
};

/// Returns surfaces that bound the active cells, with heights, which are depths turned over:
/// - `top`, the tops of the cells of layer 1; `layer 2`, `layer 3`, ..., the tops of those layers;
///   and `base`, the bases of the lowest. Where a cell ends above one that is not active, its base
///   belongs to the surface below it. Bases that are not the tops of the active cells below them
///   are in `layer 1 base`, `layer 2 base`, ....
/// - Faults: between two columns, where cells of one layer have different corners on their common
///   pillars, where cells of different layers face each other, and where only one column has a cell.
///   A face that the file counts to a fault is in the surface of that name; others that hang
///   together by pillars are in `fault 1`, `fault 2`, ....
/// - `sides`: where a cell has no neighbour, since the grid ends or the neighbour is not active.
/// Surfaces without a triangle are left out. Corners keep their doubles on vertical pillars; on
/// others x and y are interpolated along the pillar. Triangles of different surfaces fit together: a
/// corner is one vertex for all cells that have it at one depth; faces of faults and sides have all
/// corners on their two pillars as vertices; and where edges of two columns cross within a face, the
/// edges there are cut at that line, and what crosses has a vertex in common, which is rounded. A
/// quadrilateral is divided along the diagonal whose ends differ less in depth.
/// Errors: bad_number if a corner is beyond all doubles; nothing_to_do if there is no triangle. The
/// caller sets the place. Cost: n log(layers) for n cells, and layers^2 for each face of a fault.
Result<std::vector<Surface>> surfaces_of_corner_points(const CornerPointGrid& grid);

/// Returns the mean of the eight corners of each cell, rounded, with heights; cells are in the order
/// of CornerPointGrid::active, and corners are where surfaces_of_corner_points has them. Errors:
/// bad_number if a mean is beyond all doubles; the caller sets the place.
Result<std::vector<Point3>> cell_centres(const CornerPointGrid& grid);

} // namespace terrane
