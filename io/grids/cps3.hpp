// SPDX-License-Identifier: LGPL-3.0-or-later
//
// CPS-3 grids, in text.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid. Its name is on the line with "->"; without one it is called `name`. Heights are
/// listed column by column from the left, each column from the highest y down. A node has no height
/// if its value reaches the largest number on the line FSASCI. FSXINC may be missing.
/// Errors: bad_syntax, bad_number with "source:line".
Result<Grid> read_cps3(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
