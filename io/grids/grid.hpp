// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Horizons as regular grids of heights, and how a grid becomes a surface.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Heights over a regular grid, which may be turned. Node (i, j) is at
/// origin + i dx (cos r, sin r) + j dy (-sin r, cos r), r the rotation.
struct Grid {
    std::string name;
    double x = 0, y = 0;          ///< of node (0, 0)
    std::uint32_t nx = 0, ny = 0; ///< nodes along each axis, >= 1
    double dx = 0, dy = 0;        ///< steps, not 0; dy < 0: rows run the other way (y flip)
    double rotation = 0;          ///< degrees, counterclockwise from x
    std::vector<double> values;   ///< nx ny heights, node (i, j) at j nx + i; NaN: none
};

/// What the file does not say, or says otherwise.
struct ReadOptions {
    bool depth = false;  ///< grids and points: heights are depths, down; they become elevations
    double max_edge = 0; ///< points: see ConnectOptions
};

/// The surface through the nodes that have a height, front up. Nothing is invented: a cell with
/// four heights becomes two triangles, one with three becomes one, others none. A cell of four is
/// divided along the diagonal whose ends differ less in height; where they do not differ, along the
/// one from node (i, j). All nodes with a height are vertices, in the order of the values.
/// Errors: bad_option where values.size() is not nx ny; bad_number where a node is not finite;
/// nothing_to_do without a triangle. The place is left to the caller.
Result<Surface> surface_of_grid(const Grid& grid, bool depth = false);

/// The height at a place, bilinear within a cell with four heights; NaN elsewhere.
double height_at(const Grid& grid, double x, double y);

} // namespace terrane
