// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Logs of wells as tables and LAS files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/io/sections/section_text.hpp>

namespace terrane {

enum class WellFormat : std::uint8_t { csv, las };

/// Returns the format of an extension, ".las"; nothing for others.
std::optional<WellFormat> well_format(std::string_view extension);

/// Returns the names of an interval's blocks, or of the surfaces in which it runs, with " | " between them.
std::string blocks_text(const WellInterval& interval, const SectionNames& names);
std::string surfaces_text(const WellInterval& interval, const SectionNames& names);
/// Returns the units of the blocks of an interval likewise, each once; empty without units.
std::string units_text(const WellInterval& interval, const SectionNames& names);

/// Writes a row per interval and marker, by well and depth: well, kind (block, surface, marker), from, to, block, unit,
/// surface, x, y, z, x_to, y_to, z_to. A surface is an interval in surfaces; block has all blocks around it. The block
/// of a marker is the one below.
std::string wells_csv(std::span<const WellLog> logs, const SectionNames& names);

/// Writes the log of one well in LAS 2.0 (Canadian Well Logging Society, update of February 2017): DEPT and the numbers
/// BLOCK and UNIT, whose names are parameters B0, B1, ... and U1, U2, ... A number holds from its depth to the next.
/// Depths are those at which it changes, and the last one; with a step > 0, its multiples. In surfaces, and without a
/// unit, numbers are NULL. Intervals too short for doubles are left out.
std::string well_las(const WellLog& log, const SectionNames& names, double step = 0);

/// Returns the files that write_wells() writes for wells with these names.
std::vector<std::filesystem::path> well_files(std::span<const std::string> wells, WellFormat format,
                                              const std::filesystem::path& path);

/// Writes logs; all wells are one table, and one LAS file each: of several, with their names after that of the file.
/// All files are written, or none. Returns their paths. Errors: bad_option for several files on standard output, and for
/// a step that makes more than 10^7 rows; those of write_file().
Result<std::vector<std::filesystem::path>> write_wells(std::span<const WellLog> logs,
                                                       const SectionNames& names, WellFormat format,
                                                       const std::filesystem::path& path,
                                                       double step = 0);

} // namespace terrane
