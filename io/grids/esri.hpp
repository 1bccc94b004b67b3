// SPDX-License-Identifier: LGPL-3.0-or-later
//
// ESRI ASCII grids.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// A grid called `name`, its nodes the centres of the cells. Keywords in any case and order: ncols,
/// nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or dx and dy), NODATA_value
/// (-9999 where it is missing). Rows run from the highest y down.
/// Errors: bad_syntax, bad_number with "source:line".
Result<Grid> read_esri(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
