// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/count_pairs.hpp>

#include <numeric>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

namespace terrane {
namespace {

void add(PairCounts& counts, DecidedBy reason) {
    switch (reason) {
    case DecidedBy::test:
        ++counts.tested;
        break;
    case DecidedBy::patch:
        ++counts.in_patches;
        break;
    case DecidedBy::separation:
        ++counts.separated;
        break;
    case DecidedBy::exact_mesh:
        ++counts.unmoved;
        break;
    }
}

} // namespace

std::string_view name_of(PairCheck method) {
    return method == PairCheck::full ? "full" : "bounds";
}

PairCounts count_pairs(std::span<const Point3> points, std::span<const Triangle> triangles,
                       const std::function<DecidedBy(const CandidatePair&)>& decided_by,
                       const Run& run) {
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    tbb::enumerable_thread_specific<PairCounts> counts_of_threads;
    const auto count = [&](const CandidatePair& pair) {
        add(counts_of_threads.local(), decided_by(pair));
        return false; // no pair is kept
    };
    candidate_pairs_of({points, triangles}, all, {}, count, run);
    PairCounts sum;
    for (const PairCounts& c : counts_of_threads) {
        sum.tested += c.tested;
        sum.in_patches += c.in_patches;
        sum.separated += c.separated;
        sum.unmoved += c.unmoved;
    }
    const std::uint64_t n = triangles.size();
    const std::uint64_t pairs = n % 2 == 0 ? n / 2 * (n - 1) : (n - 1) / 2 * n;
    sum.apart = pairs - sum.tested - sum.in_patches - sum.separated - sum.unmoved;
    return sum;
}

} // namespace terrane
