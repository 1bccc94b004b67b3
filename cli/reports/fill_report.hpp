// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What is said of holes and of what was invented in them.
#pragma once

#include <string>

#include <terrane/cli/options/statistics.hpp>
#include <terrane/cli/stages/fill_stage.hpp>

namespace terrane::cli {

/// Per surface how many borders, holes and gaps it has.
std::string borders_text(const FillWork& work);

/// Holes by number, with their sizes; empty where there are none.
std::string holes_table(const FillWork& work);

/// What was invented: points, area, expected error and model of each hole, and of all.
std::string filled_text(const FillWork& work);

/// The same for --stats: one entry per hole.
Json json_of(const FillWork& work);

/// Invented points with their expected errors, as CSV.
std::string csv_of(const FillWork& work);

/// Before, after and expected error of each surface (fill_map.hpp).
std::string map_of(const FillWork& work);

} // namespace terrane::cli
