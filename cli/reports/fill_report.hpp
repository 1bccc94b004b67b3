// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What is said of holes and of what was invented in them.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Per surface how many borders, holes and gaps it has.
std::string borders_text(const FillWork& work);

/// Holes by number, with their sizes; empty where there are none.
std::string holes_table(const FillWork& work);

/// What was invented: points, area, expected error and model of each hole, and of all.
std::string filled_text(const FillWork& work);

/// "hole 2 of top is left open: ...", one line for each that was refused; empty: none.
std::string refusals_text(const FillWork& work);

/// Says where fillings meet other triangles, a line for each of the first ten places; empty: nowhere.
std::string contacts_text(const FillWork& work, std::span<const NewContact> contacts);

/// The same for --stats: one entry per hole.
Json json_of(const FillWork& work);

/// Invented points with their expected errors, as CSV.
std::string csv_of(const FillWork& work);

/// Before, after and expected error of each surface (fill_map.hpp).
std::string map_of(const FillWork& work);

} // namespace terrane::cli
