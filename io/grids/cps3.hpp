// SPDX-License-Identifier: LGPL-3.0-or-later
//
// CPS-3 grids, in text.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// A grid called as the line with "->" says, or `name`. Heights run down each column, from the
/// highest y on, the leftmost column first. No height: the last number of FSASCI, and what is as
/// large. FSXINC may be missing.
/// Errors: bad_syntax, bad_number with "source:line".
Result<Grid> read_cps3(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
