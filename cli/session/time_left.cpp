// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/time_left.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace terrane::cli {
namespace {

constexpr double least_share = 0.05, least_seconds = 2, least_left = 0.5;
constexpr double tolerated_rise = 2; ///< as a factor

} // namespace

void TimeLeft::update(double share, double seconds) {
    if (share < share_) said_ = unknown;
    if (share == share_)
        return; // the estimate is that of the moment in which the share was reached
    share_ = share;
    end_ = share >= least_share && seconds >= least_seconds ? seconds / share : unknown;
}

std::optional<double> TimeLeft::after(double seconds) {
    const double left = end_ - seconds;
    if (left == unknown || left < least_left || left > tolerated_rise * said_) return std::nullopt;
    said_ = std::min(said_, left);
    return said_;
}

std::string duration(double seconds) {
    constexpr double minute = 60, hour = 3600, longest = 100; // of what is said in the smaller unit
    if (seconds < longest) return fmt::format("{:.0f} s", seconds);
    if (seconds < longest * minute) return fmt::format("{:.0f} min", seconds / minute);
    return fmt::format("{:.1f} h", seconds / hour);
}

} // namespace terrane::cli
