// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <string>

namespace terrane::cli {

/// Estimates how long a stage still takes, from the share of it that is done.
///
/// (1) It says nothing before a twentieth of the stage is done and two seconds have passed.
/// (2) The estimate that it gives never rises. Where the estimate does rise, the last value stays;
///     where it rises to more than twice that, nothing is said until it has come down again.
/// (3) It gives at least half a second: an estimate that time has overtaken is not said.
class TimeLeft {
public:
    /// Takes the share that is done after `seconds`. A smaller share than before begins a new
    /// estimate.
    void update(double share, double seconds);
    /// Returns the seconds left after `seconds`, or none.
    std::optional<double> after(double seconds);

private:
    static constexpr double unknown = std::numeric_limits<double>::infinity();

    double share_ = 0;
    double end_ = unknown;  ///< seconds of the whole stage, by the last share
    double said_ = unknown; ///< the last value that was returned
};

/// Returns a time in words: "12 s", "7 min", "2.5 h".
std::string duration(double seconds);

} // namespace terrane::cli
