// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Paths of wells, from tables and from LAS files.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/sections/sections.hpp>

namespace terrane {

/// Where a well begins, at depth 0.
struct WellHead {
    std::string well{}; ///< its name; empty: of all wells that no other head names
    Point3 place;       ///< unit of the model
};

/// The wells of a file.
struct WellPaths {
    std::vector<WellPath> paths; ///< by the first line of each
    std::string unit{};          ///< of lengths, as the file states; empty: not stated
};

/// Reads the wells of a table or of a LAS file, which begins with '~'. `name` is that of a well without one.
/// - A table has a heading. Columns are separated by commas, semicolons or tabs, whichever the heading has first of
///   "; tab ,", or else by blanks; lines that begin with # are comments. Columns x, y and z (or easting, northing,
///   elevation) are vertices of paths, md their depths; without these, md, inclination and azimuth are stations of
///   surveys (surveyed_path()). Rows with the same text in column well (or name) are one well. A unit may follow a name:
///   "z (m)", md[ft].
/// - A LAS file (LAS 2.0, Canadian Well Logging Society, update of February 2017) is one well, called as WELL says. Its
///   curves X, Y and Z, or else INCL and AZIM (or DEVI, HAZI and others), are read at the depths of the first curve; rows
///   without them are skipped. The head is that of `heads`, or else at X and Y and the elevation EREF, EKB or KB of the
///   parameters.
/// Errors: bad_syntax and bad_number with "source:line"; bad_option for a survey without a head, and those of
/// surveyed_path(); unsupported for LAS of another version, depths that are times, and units that differ;
/// nothing_to_do for a file without a well.
Result<WellPaths> read_well_paths(std::string_view contents, std::string_view source,
                                  std::string_view name, std::span<const WellHead> heads);

} // namespace terrane
