// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

/// Returns the surfaces before the boundary, with what extended them.
std::vector<Surface> surfaces_before_boundary(const Arranged& arranged) {
    return {arranged.surfaces.begin(),
            arranged.surfaces.end() - static_cast<std::ptrdiff_t>(arranged.boundary_count)};
}

/// Finds the gaps of which a strip triangle has different volumes on its sides.
std::vector<bool> separating_gaps(const Arranged& sealed, const Volumes& volumes) {
    const auto& gaps = sealed.sealed->closed;
    std::vector<std::uint32_t> gap_of(sealed.exact.inputs.first.back(), no_index);
    for (std::uint32_t g = 0; g < gaps.size(); ++g)
        for (const std::uint32_t t : gaps[g].triangles) gap_of[t] = g;
    std::vector<bool> separates(gaps.size(), false);
    for (std::uint32_t t = 0; t < sealed.exact.triangles.size(); ++t) {
        if (volumes.dangles(t)) continue;
        for (const std::uint32_t parent : sealed.exact.parents_of[t])
            if (gap_of[parent] != no_index) separates[gap_of[parent]] = true;
    }
    return separates;
}

/// Sums gaps by their surfaces.
std::vector<Leak> by_pairs(std::span<const ClosedGap> gaps, const std::vector<bool>& wanted) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Leak> pairs;
    for (std::size_t g = 0; g < gaps.size(); ++g) {
        if (!wanted[g]) continue;
        const ClosedGap& gap = gaps[g];
        pairs.try_emplace({gap.from, gap.to}, Leak{gap.from, gap.to})
            .first->second.add({gap.to, 0, gap.length, gap.width, gap.width, gap.place});
    }
    std::vector<Leak> leaks;
    for (const auto& [pair, leak] : pairs) leaks.push_back(leak);
    std::ranges::stable_sort(leaks, {}, [](const Leak& leak) { return -leak.length; });
    return leaks;
}

/// Leaks by their surfaces; there is one of two surfaces.
using LeaksByPairs = std::map<std::pair<std::uint32_t, std::uint32_t>, const Leak*>;

LeakVerdict verdict_of(const Leak& leak, const LeakAdvice& advice, const LeaksByPairs& separating) {
    if (!(leak.least <= advice.distance)) return LeakVerdict::wide;
    const auto found = separating.find({leak.from, leak.to});
    if (found != separating.end() && leak.least <= found->second->largest &&
        found->second->least <= leak.largest)
        return LeakVerdict::separates;
    return leak.largest <= advice.distance ? LeakVerdict::harmless : LeakVerdict::wide;
}

} // namespace

Result<LeakAdvice> judge_leaks(const Arranged& arranged, std::span<const FreeBorder> borders,
                               const ArrangeWithinOptions& options, const Run& run) {
    return guarded("to judge leaks", "leaks", [&]() -> Result<LeakAdvice> {
        if (arranged.sealed)
            return Error{ErrorCode::bad_option, "leaks are judged before they are sealed", "seal"};
        const StageTimer timer(run, "leaks");
        const auto leaks = leaks_of(borders);
        LeakAdvice advice;
        advice.verdicts.assign(leaks.size(), LeakVerdict::wide);
        if (leaks.empty()) return advice;
        auto surfaces = surfaces_before_boundary(arranged);
        const double edge_length = median_edge_length(surfaces);
        if (!(edge_length > 0)) return advice;
        const auto choice = choose_seal(arranged.exact, edge_length, timer.inside());
        if (!choice) return choice.error();
        advice.distance = choice->distance;
        if (advice.distance == 0) return advice;
        ArrangeWithinOptions closing = options;
        closing.seal = advice.distance;
        closing.seal_automatic = false;
        closing.seal_rules.clear();
        closing.extend = 0; // the surfaces are extended already
        closing.min_volume = small_volume_for(surfaces);
        std::vector<Surface> boundary(arranged.surfaces.end() -
                                          static_cast<std::ptrdiff_t>(arranged.boundary_count),
                                      arranged.surfaces.end());
        const auto sealed = arrange_exactly_within(std::move(surfaces), std::move(boundary),
                                                   closing, timer.inside());
        if (!sealed) return sealed.error();
        const auto volumes = find_volumes(sealed->exact, timer.inside());
        if (!volumes) return volumes.error();
        advice.separating = by_pairs(sealed->sealed->closed, separating_gaps(*sealed, *volumes));
        LeaksByPairs separating;
        for (const Leak& leak : advice.separating) separating[{leak.from, leak.to}] = &leak;
        for (std::size_t l = 0; l < leaks.size(); ++l)
            advice.verdicts[l] = verdict_of(leaks[l], advice, separating);
        return advice;
    });
}

} // namespace terrane
