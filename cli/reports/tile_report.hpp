// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Reports an arrangement in tiles as JSON and as text.
#pragma once

#include <cstddef>
#include <string>

#include <terrane/algorithms/tiles/tiled_arrangement.hpp>
#include <terrane/io/text/json.hpp>

namespace terrane::cli {

/// Returns the counts of all tiles and of the one with most of each; `repaired` is null unless the
/// doubles were repaired in one process. docs/reference/statistics.md lists the keys.
detail::Json tile_json(const tiles::TiledReport& report, const RoundingReport* repaired,
                       std::size_t tiles);

/// Returns the lines that sum the result up.
std::string tile_text(const tiles::TiledReport& report, const RoundingReport* repaired,
                      const std::string& tiles);

} // namespace terrane::cli
