// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/distribution/distributed_arrangement.hpp>

namespace terrane::cli {

/// Finds and names the volumes of an arrangement in blocks, for `report`. If it is not clean, they are
/// those of the repaired whole, in the process of the first block. Call it in all processes.
Status find_block_volumes(distribution::Supersteps& blocks, distribution::DistributedReport& report,
                          distribution::BlockPiece& whole);

} // namespace terrane::cli
