// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What goes into tiles, and what comes out of them, in memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <terrane/algorithms/tiles/pieces.hpp>
#include <terrane/algorithms/tiles/supersteps.hpp>
#include <terrane/algorithms/tiles/tiled_arrangement.hpp>

namespace test_support {

using namespace terrane;

/// Reads file i of surfaces in memory: each surface is a file.
inline tiles::FileReader reader_of(const std::vector<Surface>& surfaces) {
    return [&surfaces](std::size_t file) -> Result<std::vector<Surface>> {
        return std::vector<Surface>{surfaces[file]};
    };
}

/// Joins the pieces of all tiles.
inline Result<Mesh> pieces_joined(tiles::Supersteps& tiles, const tiles::TiledReport& report) {
    tiles::PieceJoiner joiner(report.vertices, report.triangles);
    const auto added =
        tiles.visit([&](tiles::Tile& b) -> Status { return joiner.add(tiles::piece_of(b)); });
    if (!added) return added.error();
    return std::move(joiner).finish();
}

} // namespace test_support
