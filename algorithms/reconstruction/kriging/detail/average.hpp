// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Averages what weighed models say of heights.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/system.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/weights.hpp>
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>
#include <terrane/algorithms/reconstruction/kriging/nearby_rest.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

/// The average of estimates, for one set of data.
///
/// Invariant under: the order of the data; all else that changes neither distances nor differences
/// of heights, to rounding. Up to 800 data take part, of those on borders half as many at most; with
/// models that do not hold farther away, those near the hole. What the estimates leave of other data on
/// borders is added next to them, without its noise.
/// Cost: n^3 / 3 for each model and n data, n per place, and n^2 for its standard deviation. Memory:
/// n^2 doubles for each model.
class AveragedHeights {
public:
    AveragedHeights(const DataAroundHole& around, ModelAverage average, const Run& run);

    /// Estimates heights and their expected errors, NaN if they can't be told. Of no use if the run
    /// is stopped. Not thread-safe.
    [[nodiscard]] KnownHeights at(std::span<const Point3> places, const Run& run) const;

    /// Says what each model says at a place.
    [[nodiscard]] std::vector<ModelShare> shares_at(const Point3& place) const;

private:
    using Systems = std::vector<System>; ///< one per model

    [[nodiscard]] Systems systems_of(std::span<const Point3> data, const Run& run) const;
    /// Averages at a few places. `deviating`: the systems of standard deviations; none: no need.
    [[nodiscard]] KnownHeights average_at(std::span<const Point3> places,
                                          const Systems* deviating) const;
    void drop_unsolved();
    void add_rest(const DataAroundHole& around);

    ModelAverage average_;
    double ground_ = 0; ///< added to heights
    double rounding_ = 0;
    std::vector<Point3> data_; ///< that take part
    std::vector<Point3> near_; ///< the same of those near the hole
    Systems systems_;
    mutable Systems fewer_; ///< of less data, for standard deviations: once they are needed
    std::unique_ptr<NearbyRest> beside_border_; ///< in the plane
};

} // namespace terrane::kriging::detail
