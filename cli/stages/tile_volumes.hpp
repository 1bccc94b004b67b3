// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace terrane::cli {

/// Finds and names the volumes of an arrangement in tiles, for `report`. If it is not clean, they are
/// those of the repaired whole, in the process of the first tile. Call it in all processes.
Status find_tile_volumes(tiles::Supersteps& tiles, tiles::TiledReport& report,
                         tiles::TilePiece& whole);

} // namespace terrane::cli
