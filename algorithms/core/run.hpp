// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>

namespace terrane {

/// Options that control how a stage runs and never affect its result. Passed on by const&.
struct Run {
    unsigned threads = 1;   ///< >= 1; the result does not depend on it
    std::stop_token stop{}; ///< a requested stop ends the stage with ErrorCode::interrupted
    /// Receives the name of the stage and the share of it that is done, in [0, 1]; 0 as long as
    /// that is not known. It is called between steps, in the calling thread.
    std::function<void(std::string_view stage, double share)> progress{};
    /// Called when a stage, or a step of it, has ended, with its path ("arrange",
    /// "seal/arrange/search") and its wall-clock time; steps count to their stage. Calls may come
    /// from several threads at a time. StageTimes collects them.
    std::function<void(std::string_view stage, double seconds)> timing{};
};

// The times of stages, collected:
//
//   terrane::StageTimes times;
//   const auto arranged = terrane::arrange(surfaces, {}, {.timing = times.observer()});
//   const double seconds = times.latest("arrange/search");

/// The wall-clock time of a stage.
struct StageTime {
    std::size_t calls = 0; ///< how often the stage has ended
    double latest = 0;     ///< seconds of the call that ended last
    double total = 0;      ///< seconds of all calls
};

/// Collects what stages report to Run::timing. Several threads may use it at a time.
class StageTimes {
public:
    /// Returns an observer for Run::timing, which must not outlive this object.
    [[nodiscard]] std::function<void(std::string_view stage, double seconds)> observer();

    /// Adds one call of a stage.
    void add(std::string_view stage, double seconds);

    /// Seconds of the call that ended last; 0 for a stage that has not ended.
    [[nodiscard]] double latest(std::string_view stage) const;

    /// Returns all stages by their paths.
    [[nodiscard]] std::map<std::string, StageTime, std::less<>> all() const;

private:
    mutable std::mutex mutex_;
    std::map<std::string, StageTime, std::less<>> times_; ///< by path
};

} // namespace terrane
