// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Outlines in ESRI's shapefiles, read by shapelib where this build has it.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

/// Tells whether this build can read shapefiles.
bool reads_shapefiles();

/// Reads the ring of the one polygon of a .shp file, without its heights, measures and attributes; the
/// .shx, .dbf and .prj of the same name are not needed. The last corner repeats the first. Errors:
/// bad_syntax, bad_number; unsupported (a polygon with holes or parts, several polygons, points or
/// lines, a build without shapelib); nothing_to_do (no polygon). Cost: linear.
Result<std::vector<std::array<double, 2>>> read_shape_outline(std::string_view contents,
                                                              std::string_view source);

} // namespace terrane
