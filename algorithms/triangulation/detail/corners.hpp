// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace terrane::triangulation::detail {

/// Returns the corner that follows corner i of a triangle.
constexpr unsigned next(unsigned i) {
    return i == 2 ? 0 : i + 1;
}

/// Returns the corner that precedes corner i of a triangle.
constexpr unsigned previous(unsigned i) {
    return i == 0 ? 2 : i - 1;
}

/// Returns the triangle so turned that it starts with its lowest corner.
inline std::array<std::uint32_t, 3> from_lowest(const std::array<std::uint32_t, 3>& t) {
    if (t[1] < t[0] && t[1] < t[2]) return {t[1], t[2], t[0]};
    if (t[2] < t[0]) return {t[2], t[0], t[1]};
    return t;
}

} // namespace terrane::triangulation::detail
