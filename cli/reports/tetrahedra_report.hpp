// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What check_tetrahedra found, for people and for --stats.
#pragma once

#include <string>

#include <terrane/algorithms/tetgen/fill_blocks.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Whether the checks hold, how volumes compare, both histograms; classes without members left out.
std::string report_text(const TetrahedraReport& report);

/// Lists the violations, a line per kind.
std::string violations_text(const TetrahedraReport& report);

/// violations, exact_volumes, volume_difference, dihedral and radius_edge; see docs/reference/statistics.md.
Json report_json(const TetrahedraReport& report);

/// Counts, per region too, the checks and the shapes.
std::string filled_text(const FilledBlocks& filled);

/// Adds counts, volumes, checks and times of the tetrahedra.
void add_statistics(Json& json, const FilledBlocks& filled);

} // namespace terrane::cli
