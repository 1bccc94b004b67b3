// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/block_volumes.hpp>

#include <utility>

#include <terrane/algorithms/structure/names_in_blocks.hpp>
#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>
#include <terrane/algorithms/volumes/volumes_in_blocks.hpp>

namespace terrane::cli {

using namespace distribution;

Status find_block_volumes(Supersteps& blocks, DistributedReport& report, BlockPiece& whole) {
    if (report.clean) {
        auto volumes = find_volumes_in_blocks(blocks);
        if (!volumes) return volumes.error();
        report.volumes = std::move(*volumes);
        auto names = name_volumes_in_blocks(blocks);
        if (!names) return names.error();
        report.volume_names = std::move(*names);
        return count_work(blocks, report);
    }
    return blocks.visit([&](Block& b) -> Status {
        if (b.index != 0) return Done{};
        auto volumes = find_volumes(whole.mesh);
        if (!volumes) return volumes.error();
        const Structure structure = build_structure(whole.mesh, *volumes);
        for (const ModelBlock& block : structure.blocks) report.volume_names.push_back(block.name);
        report.volumes = std::move(volumes->measures);
        whole.volumes_of_sides = std::move(volumes->of_sides);
        return Done{};
    });
}

} // namespace terrane::cli
