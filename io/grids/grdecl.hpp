// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reading corner-point grids in Eclipse's keywords (.grdecl).
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/corner_point.hpp>

namespace terrane {

/// Reads SPECGRID or DIMENS, COORD, ZCORN, and, where they are there, ACTNUM, FAULTS, GRIDUNIT,
/// MAPUNITS and MAPAXES. Other keywords are passed over. Values may be repeated, as in 3*0.5; --
/// begins a comment, and / ends the values of a keyword.
/// - Units are those of GRIDUNIT, else those that METRIC or FIELD imply. MAPAXES turn and shift x
///   and y, each rounded, unless GRIDUNIT says that they are those of the map already.
/// Errors: bad_syntax, bad_number with "source:line"; unsupported: INCLUDE, IMPORT and GDFILE,
/// local and radial grids, several reservoirs, keywords that change COORD, ZCORN or ACTNUM later,
/// map axes in another unit, more than 2^29 cells, and more than 256 values per byte of the file.
/// Cost: linear in the number of values.
Result<CornerPointGrid> read_corner_points(std::string_view contents, std::string_view source);

/// Reads the grid and returns its surfaces. Errors: those of both functions.
Result<std::vector<Surface>> read_grdecl(std::string_view contents, std::string_view source);

} // namespace terrane
