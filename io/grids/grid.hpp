// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Horizons given as regular grids of heights, and their conversion to surfaces.
#pragma once

#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Options of reading.
struct ReadOptions {
    bool depth = false;  ///< grids and points: values are depths, positive down; z becomes -value
    double max_edge = 0; ///< points: longest edge, in their unit; 0: twice the median edge
    /// Unit to which coordinates with a stated unit are converted: "m", "km", "ft", "ftUS", "cm".
    /// Each is multiplied by the factor between the units and rounded once. If this is empty,
    /// coordinates stay as they are.
    std::string unit{};
    /// Columns of numbers: those of x, y and z, by number from 1 or as a heading calls them, with commas between: "3,4,5",
    /// "UTM_X,UTM_Y,Base". Empty: by what the heading calls them.
    std::string columns{};
};

/// Returns the surface through the nodes that have a height, with its front up. No heights are
/// interpolated: a cell with four heights becomes two triangles, a cell with three becomes one, and
/// other cells are left out. A cell with four heights is divided along the diagonal whose ends
/// differ less in height; if the differences are equal, along the diagonal from node (i, j). All
/// nodes with a height are vertices, in the order of the values.
/// Errors: bad_option if values.size() is not nx ny; bad_number if a node is not finite;
/// nothing_to_do if there is no triangle. The caller sets the place of the error.
Result<Surface> surface_of_grid(const Grid& grid, bool depth = false);

/// Returns the height at (x, y), bilinear within a cell with four heights; NaN elsewhere.
double height_at(const Grid& grid, double x, double y);

} // namespace terrane
