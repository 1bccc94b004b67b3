// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Grids of Surfer: text (DSAA), and binary of version 6 (DSBB) and 7 (DSRB).
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid called `name`. Rows are listed from the lowest y up. A node whose height is 1.70141e38
/// or more, or the file's own number for no data, has no height. Source: Golden Software, "Surfer
/// Grid File Formats".
/// Errors: bad_syntax, bad_number with "source:line", or "source, byte n" where the grid is binary;
/// unsupported (another file with the extension .grd, for instance a NetCDF grid of GMT).
Result<Grid> read_surfer(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
