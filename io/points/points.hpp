// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Scattered points: columns of numbers in text, and GOCAD's VSet and PLine.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// One Surface called `name` with all points as vertices, connected by connect_points; one for each
/// text that stands in front of the numbers, called so.
/// - Columns stand apart by blanks, tabs, commas or semicolons. Lines that begin with # ! @ or //
///   are comments, as are lines before the first point that begin with a word; a line EOD or EOB
///   ends the points.
/// - Which columns: those that the last line of words before the points calls x, y, z (or easting,
///   northing, depth, elevation; inline and crossline where there are no x and y), in any case;
///   else the first three numbers; of five in each line the last three (inline, crossline, x, y,
///   z).
/// - No point: z of 1e29 and more in size, -99999, -9999, -999.25; three times 999 (it ends a
/// line). Errors: bad_syntax, bad_number with "source:line"; nothing_to_do without a triangle;
/// those of connect_points.
Result<std::vector<Surface>> read_points(std::string_view contents, std::string_view source,
                                         std::string_view name, const ReadOptions& options);

/// VSet: a Surface per object. PLine: one Surface for all lines of the file, since one line is
/// none; their points are connected, not their segments. Names, ZPOSITIVE as in read_gocad; other
/// objects are not looked at. ATOM and PATOM repeat a point and are skipped. Errors: as above.
Result<std::vector<Surface>> read_gocad_points(std::string_view contents, std::string_view source,
                                               std::string_view name, const ReadOptions& options);

} // namespace terrane
