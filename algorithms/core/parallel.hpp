// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/kernel/numbers.hpp>

namespace terrane {

/// Calls `work` with the threads of the run, but not more than the machine has: TBB would print
/// that it ignores the rest. A nested call uses the threads of the outer one: an arena of its own
/// would have to wake its threads, and to wait for those that the outer one holds.
template <class Work>
void with_threads(const Run& run, const Work& work) {
    if (run.threads <= 1) return work();
    const int threads =
        std::min(static_cast<int>(std::min(run.threads, 4096U)), tbb::info::default_concurrency());
    if (tbb::this_task_arena::max_concurrency() == threads) return work();
    tbb::task_arena arena(threads);
    arena.execute(work);
}

/// Calls work(i) for each i < count, several at a time. The threads get the floating-point
/// environment of this one; by default they would have that of the thread that used TBB first.
template <class Work>
void for_each_index(std::size_t count, const Work& work) {
    tbb::task_group_context context(tbb::task_group_context::bound,
                                    tbb::task_group_context::fp_settings);
    tbb::parallel_for(std::size_t{0}, count, work, context);
}

/// Cuts [0, count) into blocks of fixed size, so that the result cannot depend on the threads, and
/// returns the Block that work(first, last) makes of each, in order. Each block runs under an
/// UpwardRounding; work that takes its witness is called as work(witness, first, last). If the run
/// is stopped, the remaining blocks stay empty.
template <class Block, class Work>
std::vector<Block> for_blocks(std::size_t count, std::size_t block_size, const Run& run,
                              const Work& work) {
    std::vector<Block> blocks((count + block_size - 1) / block_size);
    const auto one = [&](std::size_t b) {
        if (run.stop.stop_requested()) return;
        const UpwardRounding guard;
        const std::size_t first = b * block_size, last = std::min(count, first + block_size);
        if constexpr (std::is_invocable_v<const Work&, UpwardWitness, std::size_t, std::size_t>)
            blocks[b] = work(guard, first, last);
        else
            blocks[b] = work(first, last);
    };
    if (run.threads <= 1 || blocks.size() <= 1) {
        for (std::size_t b = 0; b < blocks.size(); ++b) one(b);
    } else {
        with_threads(run, [&] { for_each_index(blocks.size(), one); });
    }
    return blocks;
}

/// Returns what for_blocks returns. If the run has a callback for the progress, the blocks are
/// computed in waves, and the calling thread calls report(done) after each wave: `done` of the `count`
/// elements have been computed.
template <class Block, class Work, class Report>
std::vector<Block> for_reported_blocks(std::size_t count, std::size_t block_size, const Run& run,
                                       const Work& work, const Report& report) {
    if (!run.progress) return for_blocks<Block>(count, block_size, run, work);
    constexpr std::size_t waves = 64; // at most; threads wait for each other at the end of each
    const std::size_t blocks = std::max(count / waves / block_size, std::size_t{run.threads} * 2);
    const std::size_t wave = blocks * block_size;
    std::vector<Block> all;
    for (std::size_t start = 0; start < count; start += wave) {
        const std::size_t size = std::min(wave, count - start);
        auto some = for_blocks<Block>(size, block_size, run, [&](std::size_t a, std::size_t b) {
            return work(start + a, start + b);
        });
        std::move(some.begin(), some.end(), std::back_inserter(all));
        report(start + size);
    }
    return all;
}

/// Least number of elements that are worth a range of their own. The build for ThreadSanitizer
/// lowers it, so that several threads work on small models, too.
#ifdef TERRANE_LEAST_RANGE
inline constexpr std::size_t least_range = TERRANE_LEAST_RANGE;
#else
inline constexpr std::size_t least_range = 8192;
#endif

/// Calls work(first, last) for ranges that partition [0, count), several at a time. The results
/// must not depend on the limits of the ranges. The rounding mode is the default one. `least` is
/// the number of elements below which another range costs more than it saves.
template <class Work>
void for_ranges(std::size_t count, const Run& run, const Work& work,
                std::size_t ranges_per_thread = 4, std::size_t least = least_range) {
    const std::size_t ranges =
        run.threads <= 1 ? 1 : std::min(ranges_per_thread * run.threads, count / least + 1);
    if (ranges == 1) return work(std::size_t{0}, count);
    with_threads(run, [&] {
        for_each_index(ranges,
                       [&](std::size_t r) { work(count * r / ranges, count * (r + 1) / ranges); });
    });
}

/// Calls for_ranges and returns the results of the ranges in order.
template <class Part, class Work>
std::vector<Part> parts_of_ranges(std::size_t count, const Run& run, const Work& work,
                                  std::size_t ranges_per_thread = 4) {
    std::vector<std::pair<std::size_t, Part>> parts;
    std::mutex mutex;
    const auto one = [&](std::size_t first, std::size_t last) {
        Part part = work(first, last);
        const std::lock_guard lock(mutex);
        parts.emplace_back(first, std::move(part));
    };
    for_ranges(count, run, one, ranges_per_thread);
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Part> sorted;
    for (auto& [first, part] : parts) sorted.push_back(std::move(part));
    return sorted;
}

/// Concatenates all parts.
template <class T>
std::vector<T> concatenated(std::vector<std::vector<T>> parts) {
    if (parts.empty()) return {};
    std::vector<T> all = std::move(parts.front());
    for (std::size_t p = 1; p < parts.size(); ++p)
        all.insert(all.end(), parts[p].begin(), parts[p].end());
    return all;
}

/// Calls both functions, at the same time if the run has several threads.
template <class First, class Second>
void both(const Run& run, const First& first, const Second& second) {
    if (run.threads <= 1) {
        first();
        second();
        return;
    }
    with_threads(run, [&] {
        tbb::task_group_context context(tbb::task_group_context::bound,
                                        tbb::task_group_context::fp_settings);
        tbb::parallel_invoke(first, second, context);
    });
}

} // namespace terrane
