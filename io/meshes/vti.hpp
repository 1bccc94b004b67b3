// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids as ImageData of VTK's XML format (.vti).
#pragma once

#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Returns the grid as an image at z = 0, whose only array has its name and its values, NaN where there is none.
/// A rotation is its Direction, which VTK reads since version 9. Errors: those of to_esri().
Result<std::string> to_vti(const Grid& grid);

} // namespace terrane
