// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/tile_volumes.hpp>

#include <utility>

#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tiles/names_in_tiles.hpp>
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane::cli {

using namespace tiles;

Status find_tile_volumes(Supersteps& tiles, TiledReport& report, TilePiece& whole) {
    if (report.clean) {
        auto volumes = find_volumes_in_tiles(tiles);
        if (!volumes) return volumes.error();
        report.volumes = std::move(*volumes);
        auto names = name_volumes_in_tiles(tiles);
        if (!names) return names.error();
        report.volume_names = std::move(*names);
        return count_work(tiles, report);
    }
    return tiles.visit([&](Tile& b) -> Status {
        if (b.index != 0) return Done{};
        auto volumes = find_volumes(whole.mesh);
        if (!volumes) return volumes.error();
        const Structure structure = build_structure(whole.mesh, *volumes);
        for (const ModelBlock& block : structure.blocks) report.volume_names.push_back(block.name);
        whole.volumes_of_sides = std::move(volumes->of_sides);
        report.volumes = std::move(*volumes);
        return Done{};
    });
}

} // namespace terrane::cli
