// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// Places of nodes, and back.
class GridFrame {
public:
    explicit GridFrame(const Grid& grid);

    /// Returns the place of node (i, j), at height z.
    [[nodiscard]] Point3 node(double i, double j, double z = 0) const {
        const double u = i * dx_, v = j * dy_;
        return {x_ + u * cosine_ - v * sine_, y_ + u * sine_ + v * cosine_, z};
    }
    /// Returns (i, j, 0) of a place, in floating point.
    [[nodiscard]] Point3 steps(double x, double y) const {
        return {((x - x_) * cosine_ + (y - y_) * sine_) / dx_,
                ((y - y_) * cosine_ - (x - x_) * sine_) / dy_, 0};
    }

private:
    double x_, y_, dx_, dy_;
    double cosine_ = 1, sine_ = 0; ///< exact for multiples of 90 degrees
};

} // namespace terrane
