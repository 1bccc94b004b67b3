// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/count_pairs.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>

namespace terrane {

std::string_view name_of(PairCheck method) {
    return method == PairCheck::full ? "full" : "bounds";
}

std::optional<PairCounts>
count_pairs(std::span<const Point3> points, std::span<const Triangle> triangles,
            const std::function<DecidedBy(const CandidatePair&)>& decided_by, std::uint64_t most,
            const Run& run) {
    if (most == 0) return std::nullopt;
    const StageTimer timer(run, "count_pairs");
    const auto class_of = [&](const CandidatePair& pair) {
        return static_cast<std::size_t>(decided_by(pair));
    };
    const auto counts =
        count_candidate_pairs({points, triangles}, class_of, most, without_progress(run));
    if (!counts) return std::nullopt;
    const auto count = [&](DecidedBy reason) {
        return counts->at(static_cast<std::size_t>(reason));
    };
    PairCounts sum{.tested = count(DecidedBy::test),
                   .in_patches = count(DecidedBy::patch),
                   .separated = count(DecidedBy::separation),
                   .unmoved = count(DecidedBy::exact_mesh)};
    const std::uint64_t n = triangles.size();
    const std::uint64_t pairs = n % 2 == 0 ? n / 2 * (n - 1) : (n - 1) / 2 * n;
    sum.apart = pairs - sum.tested - sum.in_patches - sum.separated - sum.unmoved;
    return sum;
}

} // namespace terrane
