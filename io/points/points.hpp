// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Scattered points, from columns of numbers in text and from GOCAD's VSet and PLine.
#pragma once

#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/io/grids/grid.hpp>

namespace terrane {

/// Reads one Surface called `name` with all points as vertices, and connects them by
/// connect_points. If lines begin with a text, or a heading names a column surface, formation,
/// horizon, fault, unit or name, there is one Surface for each text in that column, called so;
/// horizon and fault state its role.
/// - Columns are separated by blanks, tabs, commas or semicolons. Lines that begin with # ! @ or //
///   are comments, and so are lines before the first point that begin with a word. A line EOD or
///   EOB ends the points.
/// - A heading, the last line before the points that names x, y and z, tells their columns (or
///   easting, northing, elevation, depth and others; inline and crossline if there are no x and y),
///   in any case; so do "# Field:" lines of EarthVision and Petrel's BEGIN HEADER. A heading of
///   other names is an error. A unit may follow a name: depth_ft, "z (m)", x[m]. Columns of a heading with commas,
///   semicolons or tabs are separated by these alone, so cells may be empty. Without a heading the
///   coordinates are the first three numbers, or the last three if the first point has five numbers
///   (inline, crossline, x, y, z).
/// - Commas are decimal points where meaning_of_commas() says so (detail/heading.hpp).
/// - A point is skipped if its z is -99999, -9999, -999.25 or at least 1e29 in size, or if its
///   three numbers are 999, which end a line.
/// Errors: bad_syntax, bad_number with "source:line"; nothing_to_do if there is no triangle; those
/// of connect_points.
Result<std::vector<Surface>> read_points(std::string_view contents, std::string_view source,
                                         std::string_view name, const ReadOptions& options);

/// Reads one Surface per VSet object, and one Surface for all PLine objects of a file together,
/// since a single line makes no surface; the points are connected, segments are ignored. Names and
/// ZPOSITIVE are read as by read_gocad; other objects are skipped, as are ATOM and PATOM, which
/// repeat a point. Errors: those of read_points.
Result<std::vector<Surface>> read_gocad_points(std::string_view contents, std::string_view source,
                                               std::string_view name, const ReadOptions& options);

} // namespace terrane
