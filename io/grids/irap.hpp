// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Irap classic grids, in text and in binary.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// A grid called `name`. Binary where the file begins with the length of a FORTRAN record, 32, as a
/// big-endian integer; text otherwise. Both begin with -996. The first node is the point about
/// which the grid is turned; heights run along x first, from the lowest row up. No height: 9999900
/// and more in text, 1e30 and more in binary. Binary heights and coordinates are float32.
/// Errors: bad_syntax, bad_number with "source:line" or "source, byte n".
Result<Grid> read_irap(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
