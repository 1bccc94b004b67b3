// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A partition of unity over scattered values: interpolates any number of them, and is 0 away from
// them. Private to rbf.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Cells of at most 48 points by halving at the median; round each a ball half as large again as
/// the cell's, with the sum of w_i |p - p_i| plus a constant that takes the values at all points in
/// the ball. Balls are blended by Wendland's weights of their cells, divided by their sum where
/// that is more than at the rim of a cell: so the values are met, and what is beyond all balls is
/// 0. Cost: linear in the points, but for sorting; a few balls per value.
class RbfPatches {
public:
    RbfPatches() = default;
    /// The points are distinct.
    RbfPatches(std::span<const Point3> points, std::span<const double> values);

    [[nodiscard]] std::size_t size() const { return patches_.size(); }
    [[nodiscard]] double operator()(const Point3& p) const;

private:
    struct Patch {
        Point3 centre;
        double radius = 0; ///< of the ball
        double constant = 0;
        std::vector<Point3> points;
        std::vector<double> weights; ///< per point, and unit of distance
    };
    struct Node {                          ///< of a tree over the points; its leaves are the cells
        Point3 low, high;                  ///< of its points
        Point3 ball_low, ball_high;        ///< of the balls in it
        std::uint32_t first = 0, last = 0; ///< places in the order of points
        std::uint32_t left = 0, right = 0; ///< children; 0: a leaf
        std::uint32_t patch = 0;           ///< of a leaf
    };
    struct Values {
        std::span<const Point3> points;
        std::span<const double> values;
        std::vector<std::uint32_t> order;
    };

    std::uint32_t build(Values& data, std::uint32_t first, std::uint32_t last);
    [[nodiscard]] std::vector<std::uint32_t> points_in(const Values& data, const Point3& centre,
                                                       double radius) const;
    void fit(const Values& data, Patch& patch) const;
    void bound_balls();

    std::vector<Patch> patches_;
    std::vector<Node> nodes_;
};

} // namespace terrane
