// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Finds the volumes of a mesh that lies in tiles, in one process or many.
//
// Guarantees: numbers and measures are those that find_volumes() gives for the mesh of all pieces
// together, for any number of tiles.
// The tiles join the sides of their triangles round edges to shells; a shared edge is decided in one
// tile. The first tile joins the shells of all tiles. It holds one entry for each shell of a tile,
// for each pair of shells that touch across tiles, and for each hit of a line (one line for each
// component). Cost: that of find_volumes(), divided by the number of tiles as far as triangles balance.
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::tiles {

/// Finds the volumes of the nearest doubles after arrange_in_tiles(), which must have reported a
/// conforming mesh. Returns them without sides in all processes; piece_of() then tells the volumes on
/// both sides of each triangle. Errors: internal if triangles overlap, so that the mesh is not
/// conforming.
Result<Volumes> find_volumes_in_tiles(Supersteps& tiles);

} // namespace terrane::tiles
