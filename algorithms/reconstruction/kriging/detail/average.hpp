// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Averages what weighed models say of heights.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/weights.hpp>
#include <terrane/algorithms/reconstruction/kriging/flat_hole.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

/// The average of estimates, for one set of data.
///
/// Invariant under: the order of the data; all else that changes neither distances nor differences
/// of heights, to rounding. Up to 1000 data take part, of those on borders half as many at most. What
/// the estimates leave of other data on borders is added next to them, without its noise.
/// Cost: n^3 / 3 for each model and n data, n per place, and n^2 for its standard deviation. Memory:
/// n^2 doubles for each model.
class AveragedHeights {
public:
    AveragedHeights(const DataAroundHole& around, const ModelAverage& average, const Run& run);
    AveragedHeights(AveragedHeights&&) noexcept;
    ~AveragedHeights();

    /// Estimates heights and their expected errors, NaN if they can't be told. Of no use if the run
    /// is stopped.
    [[nodiscard]] KnownHeights at(std::span<const Point3> places, const Run& run) const;

    /// Says what each model says at a place.
    [[nodiscard]] std::vector<ModelShare> shares_at(const Point3& place) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace terrane::kriging::detail
