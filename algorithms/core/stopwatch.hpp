// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <utility>

namespace terrane {

/// Measures wall-clock time.
class Stopwatch {
public:
    /// Returns the seconds since the previous call, or since the construction.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace terrane
