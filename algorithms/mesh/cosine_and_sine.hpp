// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace terrane {

/// Returns cosine and sine of an angle; they are exact for multiples of 90 degrees.
inline std::array<double, 2> cosine_and_sine(double degrees) {
    const double angle = std::remainder(degrees, 360.0);
    if (angle == 0) return {1, 0};
    if (std::fabs(angle) == 180) return {-1, 0};
    if (std::fabs(angle) == 90) return {0, angle / 90};
    const double radians = angle / 180 * std::numbers::pi;
    return {std::cos(radians), std::sin(radians)};
}

} // namespace terrane
