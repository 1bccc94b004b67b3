// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Adds to a function what it leaves of data, next to them.
#pragma once

#include <span>
#include <vector>

#include <terrane/algorithms/reconstruction/kriging/cloud.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// The mean of the nearest eight values, weighted by inverse fourth powers of distances, which fades
/// to 0 at a distance: so the values themselves are met, whatever their number, and nothing is
/// changed away from them. Source: Shepard (1968).
class NearbyRest {
public:
    /// `points`: distinct; `reach`: distance from the nearest point at which the rest is 0.
    NearbyRest(std::span<const Point3> points, std::vector<double> values, double reach);
    NearbyRest(const NearbyRest&) = delete;
    NearbyRest& operator=(const NearbyRest&) = delete;

    [[nodiscard]] double operator()(const Point3& p) const;

private:
    Cloud cloud_;
    std::vector<double> values_;
    double reach_;
    CloudTree<3> tree_;
};

} // namespace terrane
