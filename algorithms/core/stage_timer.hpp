// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages report their times to Run::timing through one helper.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/core/stopwatch.hpp>

namespace terrane {

/// Measures a stage from its construction to its end, and reports it to the run, which must outlive
/// the timer. A stage that fails is reported as well. Names of stages are literals.
class StageTimer {
public:
    StageTimer(const Run& run, std::string_view stage) : run_(run), stage_(stage) {}
    ~StageTimer() {
        try {
            stop();
        } catch (...) { // an observer that fails loses the time, and the stage nothing
        }
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

    /// Returns the run for the steps of the stage: their paths begin with the stage.
    [[nodiscard]] Run inside() const {
        Run inner = run_;
        if (run_.timing)
            inner.timing = [&outer = run_, stage = stage_](std::string_view step, double seconds) {
                outer.timing(std::string(stage).append("/").append(step), seconds);
            };
        return inner;
    }

    /// Ends the stage and begins another one.
    void next(std::string_view stage) {
        stop();
        stage_ = stage;
        watch_.lap();
    }

    /// Ends the stage.
    void stop() {
        if (!stage_.empty() && run_.timing) run_.timing(std::exchange(stage_, {}), watch_.lap());
    }

private:
    const Run& run_;
    std::string_view stage_; ///< empty: it has ended
    Stopwatch watch_;
};

} // namespace terrane
