// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The times of stages, collected:
//
//   terrane::StageTimes times;
//   const auto arranged = terrane::arrange(surfaces, {}, {.timing = times.observer()});
//   const double seconds = times.latest("arrange/search");
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace terrane {

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
