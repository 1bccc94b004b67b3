// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Merges blocks that are too small to matter with their neighbours. Nearly equal surfaces, and gaps
// that were closed, leave slivers of a few cubic metres between them, which no simulation needs and
// for which every mesher pays.
//
// A block is merged by removing its largest interface: the triangles between it and one neighbour
// that belong to the same surfaces. Nothing else changes: no vertex moves, and no triangle is
// added. The smallest block comes first; merged blocks count as one block from then on. The
// outside is a neighbour only of a block that has no other, and no boundary of the model is removed
// there. Cost: that of find_volumes, and sorting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/core/named_constant.hpp>
#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane {

/// A block that became part of a neighbour.
struct MergedBlock {
    double volume = 0;         ///< cubic unit of the input
    double thickness = 0;      ///< twice its volume, divided by the area of its boundary; unit
    double into = 0;           ///< volume of the neighbour before; infinite: the outside
    double area = 0;           ///< of the triangles that were removed, squared unit
    std::size_t triangles = 0; ///< that were removed
    std::vector<std::uint32_t> surfaces{}; ///< that these belonged to, ascending
    Point3 place{};                        ///< centre of the first of these
};

/// The blocks that became part of others.
struct BlockMerge {
    double least = 0;                  ///< volume below which blocks were merged, cubic unit
    std::vector<MergedBlock> merged{}; ///< from the smallest on
    std::size_t kept = 0; ///< blocks below `least` that have no neighbour to be merged with
};

/// An arrangement without small blocks.
struct WithoutSmallBlocks {
    Arrangement arrangement; ///< restricted to the triangles that are kept
    BlockMerge report;       ///< the merged blocks
};

/// Merges all blocks whose exact volume is below `least`. Errors: bad_option (`least` is not
/// positive and finite), those of find_volumes.
Result<WithoutSmallBlocks> merge_small_blocks(Arrangement arrangement, double least,
                                              const Run& run = {});

/// Returns the median length of the edges of all triangles; 0 if there are none. Each triangle
/// counts for each of its edges.
double median_edge_length(std::span<const Surface> surfaces);

/// Returns the volume below which a block is certainly dirt: that of a cube whose edges are a tenth
/// of the median edge length. A thin layer that goes on for many triangles is larger.
double small_volume_for(std::span<const Surface> surfaces);

/// Lists the constants that decide the result and are not options.
std::vector<NamedConstant> small_block_constants();

} // namespace terrane
