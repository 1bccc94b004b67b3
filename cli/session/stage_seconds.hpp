// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Where the time of a run went: each second counts for one stage, the innermost one that has a name of
// its own, so that all stages together took what the run took.
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrane::cli {

/// Collects what stages report to Run::timing when they end. A stage that ended within another one is
/// taken off the time of that one.
class StageSeconds {
public:
    using Clock = std::chrono::steady_clock;

    /// Notes that a stage has ended that took so long. `path` is that of Run::timing.
    void end(std::string_view path, double seconds, Clock::time_point now = Clock::now());
    /// Returns the stages in the order in which they ended first, and their seconds.
    [[nodiscard]] std::vector<std::pair<std::string, double>> all() const;

private:
    struct Ended {
        Clock::time_point begin;
        double seconds;
    };

    mutable std::mutex mutex_;
    std::vector<Ended> ended_; ///< stages that are within no other one that has ended
    std::vector<std::pair<std::string, double>> seconds_;
};

} // namespace terrane::cli
