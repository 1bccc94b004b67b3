// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Irap classic grids, in text and in binary.
#pragma once

#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads a grid called `name`. The file is binary if it begins with the length of a FORTRAN record,
/// 32, as a big-endian integer; otherwise it is text. The header of both begins with -996. The grid
/// is rotated about its first node; heights are listed row by row from the lowest row up. A node
/// has no height if its value is at least 9999900 in text, or 1e30 in binary. Heights and
/// coordinates in binary are float32.
/// Errors: bad_syntax, bad_number with "source:line" or "source, byte n".
Result<Grid> read_irap(std::string_view contents, std::string_view source, std::string_view name);

} // namespace terrane
