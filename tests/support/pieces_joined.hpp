// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What goes into blocks, and what comes out of them, in memory.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <terrane/algorithms/distribution/distributed_arrangement.hpp>
#include <terrane/algorithms/distribution/pieces.hpp>
#include <terrane/algorithms/distribution/supersteps.hpp>

namespace test_support {

using namespace terrane;

/// Reads file i of surfaces in memory: each surface is a file.
inline distribution::FileReader reader_of(const std::vector<Surface>& surfaces) {
    return [&surfaces](std::size_t file) -> Result<std::vector<Surface>> {
        return std::vector<Surface>{surfaces[file]};
    };
}

/// Joins the pieces of all blocks.
inline Result<Mesh> pieces_joined(distribution::Supersteps& blocks,
                                  const distribution::DistributedReport& report) {
    distribution::PieceJoiner joiner(report.vertices, report.triangles);
    const auto added = blocks.visit(
        [&](distribution::Block& b) -> Status { return joiner.add(distribution::piece_of(b)); });
    if (!added) return added.error();
    return std::move(joiner).finish();
}

} // namespace test_support
