// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/run.hpp>

namespace terrane {

std::function<void(std::string_view stage, double seconds)> StageTimes::observer() {
    return [this](std::string_view stage, double seconds) { add(stage, seconds); };
}

void StageTimes::add(std::string_view stage, double seconds) {
    const std::lock_guard lock(mutex_);
    StageTime& time = times_[std::string(stage)];
    ++time.calls;
    time.latest = seconds;
    time.total += seconds;
}

double StageTimes::latest(std::string_view stage) const {
    const std::lock_guard lock(mutex_);
    const auto found = times_.find(stage);
    return found == times_.end() ? 0 : found->second.latest;
}

std::map<std::string, StageTime, std::less<>> StageTimes::all() const {
    const std::lock_guard lock(mutex_);
    return times_;
}

} // namespace terrane
