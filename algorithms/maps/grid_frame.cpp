// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/maps/grid_frame.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace terrane {

GridFrame::GridFrame(const Grid& grid) : x_(grid.x), y_(grid.y), dx_(grid.dx), dy_(grid.dy) {
    const double quarter = std::remainder(grid.rotation, 360.0) / 90;
    if (quarter == std::round(quarter)) {
        constexpr std::array<double, 5> sines{0, -1, 0, 1, 0}; // -2 .. 2 quarters
        constexpr std::array<double, 5> cosines{-1, 0, 1, 0, -1};
        const auto i = static_cast<std::size_t>(quarter + 2);
        cosine_ = cosines[i];
        sine_ = sines[i];
        return;
    }
    const double angle = grid.rotation * std::numbers::pi / 180;
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
}

} // namespace terrane
