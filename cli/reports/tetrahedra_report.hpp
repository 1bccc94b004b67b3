// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on check_tetrahedra, as text and for --stats.
#pragma once

#include <string>

#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/check_tetrahedra.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Lists the violations, a line per kind.
std::string violations_text(const TetrahedraReport& report);

/// Returns violations, exact_volumes, volume_difference, dihedral and radius_edge
/// (docs/reference/statistics.md).
Json report_json(const TetrahedraReport& report);

/// Reports the counts, in all and per block, the checks and the shapes. `unit` is that of the
/// coordinates; empty: unknown.
std::string filled_text(const FilledBlocks& filled, const std::string& unit);

/// Adds counts, volumes, checks and times of the tetrahedra.
void add_statistics(Json& json, const FilledBlocks& filled);

/// Reports the changes of improved surfaces where tetrahedra were bad: the rounds in which
/// triangles became smaller, and how far vertices moved; empty without a change.
std::string changes_text(const Built& built, const std::string& unit);

/// Adds these changes to the statistics of the tetrahedra, which are there.
void add_changes(Json& json, const Built& built);

} // namespace terrane::cli
