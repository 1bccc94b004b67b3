// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading VTK's legacy format (.vtk).
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// Reads POLYDATA, text or binary, of versions 1 to 5: the polygons and triangle strips become one
/// surface, `name`; vertices and lines are passed over, and what follows the geometry is not read.
/// Polygons become fans round their first corner. The surface has only the vertices that it uses.
/// Errors: bad_syntax, bad_number, bad_index with "source:line", or "source, byte n" where the data
/// are binary; unsupported (another DATASET); nothing_to_do if there is no triangle. Cost: linear.
Result<std::vector<Surface>> read_vtk(std::string_view contents, std::string_view source,
                                      std::string_view name);

} // namespace terrane
