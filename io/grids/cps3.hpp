// SPDX-License-Identifier: LGPL-3.0-or-later
//
// CPS-3 grids, in text.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid. Its name is on the line with "->"; without one it is called `name`. Heights are
/// listed column by column from the left, each column from the highest y down. The number of the
/// largest size on the line FSASCI, and values beyond it, mean that a node has no height. FSXINC
/// may be missing.
/// Errors: bad_syntax, bad_number with "source:line".
Result<Grid> read_cps3(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
