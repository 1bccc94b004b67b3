// SPDX-License-Identifier: LGPL-3.0-or-later
//
// A partition of unity over scattered values: interpolates any number of them and vanishes away
// from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane::rbf::detail {

/// Cells of at most 48 points result from bisection at the median. Around each cell is a ball of
/// one and a half times its radius, with a function sum of w_i |p - p_i| plus a constant that
/// interpolates the values at all points in the ball. The functions are blended with Wendland
/// weights, divided by their sum where that exceeds the weight at the rim of a cell: so the values
/// are interpolated, and the function is 0 outside of all balls. Cost: linear in the points, except
/// for sorting; a few balls per value.
class RbfPatches {
public:
    RbfPatches() = default;
    /// The points must be distinct.
    RbfPatches(std::span<const Point3> points, std::span<const double> values);

    [[nodiscard]] std::size_t size() const { return patches_.size(); }
    [[nodiscard]] double operator()(const Point3& p) const;

private:
    struct Patch {
        Point3 centre;
        double radius = 0; ///< of the ball
        double constant = 0;
        std::vector<Point3> points;
        std::vector<double> weights; ///< per point and unit of distance
    };
    struct Node {                          ///< of a tree over the points; its leaves are the cells
        Point3 low, high;                  ///< bounding box of its points
        Point3 ball_low, ball_high;        ///< bounding box of the balls in it
        std::uint32_t first = 0, last = 0; ///< range in Values::order
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

} // namespace terrane::rbf::detail
