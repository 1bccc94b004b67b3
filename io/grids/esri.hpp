// SPDX-License-Identifier: LGPL-3.0-or-later
//
// ESRI ASCII grids.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid called `name`, whose nodes are the centres of the cells. The keywords may be in any
/// case and order: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or dx
/// and dy), NODATA_value (-9999 if it is missing). Rows are listed from the highest y down.
/// Errors: bad_syntax, bad_number with "source:line".
Result<Grid> read_esri(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
