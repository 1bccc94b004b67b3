// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports on holes and on their fillings.
#pragma once

#include <span>
#include <string>

#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// Counts the borders, holes and gaps of each surface.
std::string borders_text(const FillWork& work);

/// Lists the holes by number, with their sizes; empty if there are none.
std::string holes_table(const FillWork& work);

/// Reports points, area, expected error and model of each filled hole, and the totals.
std::string filled_text(const FillWork& work);

/// Says why holes stay open, one line each: "terrane: hole 2 of top is left open: ..."; empty if
/// all are filled.
std::string refusals_text(const FillWork& work);

/// Lists places where fillings meet other triangles, the first ten, one line each; empty if there
/// are none.
std::string contacts_text(const FillWork& work, std::span<const NewContact> contacts);

/// Adds the key holes, one entry per hole, and the constants of the methods in use.
void add_statistics(Json& json, const FillWork& work);

/// Returns the added points with their expected errors, as CSV.
std::string csv_of(const FillWork& work);

/// Draws heights before and after, and the expected error, of each surface (fill_map.hpp).
std::string map_of(const FillWork& work);

} // namespace terrane::cli
