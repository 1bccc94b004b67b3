// SPDX-License-Identifier: LGPL-3.0-or-later
//
// ZMAP+ grids, in text.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid. Its name is on the line with '@'; without one it is called `name`. Comments (!)
/// are skipped, as is a line of a single '+' before the heights. Heights are listed column by
/// column from the left, each column from the highest y down; they are separated by blanks, or are
/// in fields of the width that the header states. A node has no height if its value is the number
/// or the text that the header states for this.
/// Errors: bad_syntax, bad_number with "source:line"; unsupported if the file is not a GRID.
Result<Grid> read_zmap(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
