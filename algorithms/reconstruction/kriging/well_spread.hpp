// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Selects few of many data, whatever their order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace terrane {

/// Selects `count` points, each as far as possible from those before it in x and y; the first one
/// is farthest from the mean. Of points as far as each other the one farthest from the mean height
/// is taken, so that neither the order of the points decides nor the direction of the axes.
std::vector<std::uint32_t> well_spread_in_plane(std::span<const Point3> points, std::size_t count);

/// Points from which a covariance can be told.
struct SpreadPairs {
    std::vector<std::uint32_t> chosen; ///< well-spread points, then the neighbours of some
    double gap = 0; ///< median distance of some and their nearest points; 0 if there are none
};

/// Selects `count` well-spread points and, for the first `pairs` of them, the nearest point that is
/// not taken yet, of equally near ones that farthest from the mean height. Such pairs tell noise from
/// a surface that is rough within the distance of well-spread points.
SpreadPairs well_spread_pairs(std::span<const Point3> points, std::size_t count, std::size_t pairs);

/// Computes the standard deviation of the error that rounding to doubles adds to estimates of
/// heights z with a trend of this degree.
double rounding_of(std::span<const Point3> data, unsigned degree = 1);

} // namespace terrane
