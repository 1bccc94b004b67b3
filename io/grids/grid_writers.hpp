// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Writes grids. Numbers are the shortest decimals that read back as the same doubles; where the header has the last
// node instead of the step, the step reads back rounded. Rows and columns run along growing coordinates. Where a
// value equals the usual number for no value, another number stands for it.
// Errors, without a place: bad_option for steps or numbers of values that are wrong; unsupported for a rotated grid in
// a format without rotation; bad_number for a value that the format takes for none.
#pragma once

#include <string>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Returns an ESRI ASCII grid. Steps that differ are dx and dy, which GDAL reads.
Result<std::string> to_esri(const Grid& grid);
/// Returns a ZMAP+ grid.
Result<std::string> to_zmap(const Grid& grid);
/// Returns an Irap classic grid in text, which may be rotated.
Result<std::string> to_irap(const Grid& grid);
/// Returns a grid of Surfer in text (DSAA): its binary version 6 has floats only.
Result<std::string> to_surfer(const Grid& grid);

/// Checks a grid and turns its rows and columns, so that both steps are positive.
Result<Grid> upright(const Grid& grid, bool may_turn = true);

} // namespace terrane
