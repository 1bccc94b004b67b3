// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/arrange_within.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

Result<SealTrial> try_distance(double distance, double small_volume,
                               const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary, ArrangeWithinOptions options,
                               const Run& run) {
    options.seal = distance;
    options.seal_automatic = false;
    options.min_volume = 0;
    if (distance == 0) options.seal_rules.clear();
    const auto arranged = arrange_exactly_within(surfaces, boundary, options, run);
    if (!arranged) return arranged.error();
    const auto volumes = find_volumes(arranged->exact, run);
    if (!volumes) return volumes.error();
    SealTrial trial;
    trial.distance = distance;
    trial.blocks = volumes->block_count();
    trial.small = static_cast<std::size_t>(
        std::count_if(volumes->measures.begin() + 1, volumes->measures.end(),
                      [&](double volume) { return volume < small_volume; }));
    if (!arranged->sealed) return trial;
    trial.changes = arranged->sealed->changes.size();
    for (const SealChange& change : arranged->sealed->changes) {
        trial.triangles += change.triangles;
        trial.length += change.length;
    }
    trial.left = arranged->sealed->left;
    return trial;
}

} // namespace

Result<SealAdvice> advise_seal(const std::vector<Surface>& surfaces,
                               const std::vector<Surface>& boundary,
                               const ArrangeWithinOptions& options, const Run& run) {
    return guarded("for the widths of gaps", "seal", [&]() -> Result<SealAdvice> {
        SealAdvice advice;
        auto choice = choose_seal(surfaces, boundary, options, run);
        if (!choice) return choice.error();
        advice.choice = std::move(*choice);
        advice.small_volume = small_volume_for(surfaces);
        std::vector<double> distances{0};
        for (const GapBreak& b : advice.choice.breaks) distances.push_back(b.distance);
        for (const double distance : distances) {
            auto trial =
                try_distance(distance, advice.small_volume, surfaces, boundary, options, run);
            if (!trial) return trial.error();
            advice.trials.push_back(*trial);
        }
        return advice;
    });
}

} // namespace terrane
