// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <terrane/algorithms/run.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane {

/// Cuts [0, count) into blocks of fixed size (so the result cannot depend on the threads), makes a
/// Block for each by work(first, last) and returns them in order. Each block runs under an
/// UpwardRounding. Stops early, with blocks left empty, when the run is stopped.
template <class Block, class Work>
std::vector<Block> for_blocks(std::size_t count, std::size_t block_size, const Run& run,
                              const Work& work) {
    std::vector<Block> blocks((count + block_size - 1) / block_size);
    const auto one = [&](std::size_t b) {
        if (run.stop.stop_requested()) return;
        const UpwardRounding guard;
        blocks[b] = work(b * block_size, std::min(count, (b + 1) * block_size));
    };
    if (run.threads <= 1 || blocks.size() <= 1) {
        for (std::size_t b = 0; b < blocks.size(); ++b) one(b);
    } else {
        tbb::task_arena arena(static_cast<int>(run.threads));
        arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks.size(), one); });
    }
    return blocks;
}

} // namespace terrane
