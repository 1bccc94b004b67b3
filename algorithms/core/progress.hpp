// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// Returns the run for a part of a stage: what the part reports of its own progress, in [0, 1],
/// becomes the stage's, between `from` and `to`. The run and the name must outlive it.
inline Run part_of_stage(const Run& run, std::string_view stage, double from, double to) {
    Run part = run;
    if (run.progress)
        part.progress = [&outer = run, stage, from, to](std::string_view, double share) {
            outer.progress(stage, from + (to - from) * share);
        };
    return part;
}

/// Returns the same run without the callback for the progress, for parts of unknown share.
inline Run without_progress(const Run& run) {
    Run part = run;
    part.progress = nullptr;
    return part;
}

/// Reports that `done` of `count` things are done, which are the part between `from` and `to` of a
/// stage.
inline void report_part(const Run& run, std::string_view stage, double from, double to,
                        std::size_t done, std::size_t count) {
    if (!run.progress || count == 0) return;
    run.progress(stage,
                 from + (to - from) * static_cast<double>(done) / static_cast<double>(count));
}

} // namespace terrane
