// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>

namespace test_support {

/// Returns a fold as OBJ, with a hole over which only a part of the fold's own limb lies: not a
/// graph.
inline std::string holed_fold_as_obj() {
    std::string fold;
    const int n = 40;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double t = 2 * M_PI * i / n;
            fold += "v " + std::to_string(6.0 * i - 40 * std::sin(2 * t)) + " " +
                    std::to_string(6.0 * j) + " " + std::to_string(60 * std::sin(t)) + "\n";
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            if (std::hypot(i + 0.5 - 18, j + 0.5 - 20) < 4) continue;
            const int a = j * (n + 1) + i + 1, d = a + n + 1;
            fold += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
                    std::to_string(d + 1) + " " + std::to_string(d) + "\n";
        }
    return fold;
}

} // namespace test_support
