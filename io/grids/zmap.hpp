// SPDX-License-Identifier: LGPL-3.0-or-later
//
// ZMAP+ grids, in text.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// A grid called as the line with '@' says, or `name`. Comments (!) are skipped, as is a line that
/// begins with '+'. Heights run down each column, from the highest y on, the leftmost column first.
/// Numbers stand apart, or in fields as wide as the header says. No height: the header's number or
/// its text.
/// Errors: bad_syntax, bad_number with "source:line"; unsupported: not a GRID.
Result<Grid> read_zmap(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
