// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <utility>

namespace terrane {

/// Wall-clock seconds between calls of lap().
class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

} // namespace terrane
