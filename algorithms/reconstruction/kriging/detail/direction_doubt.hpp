// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tells how much the direction of a variogram is to be doubted inside a hole.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/choice.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/kriging.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

/// Keeps up to `most_error_data` of the data, half of them on the border, well spread; up to
/// `most_noisy_data` if they are noisy, as the more there are the less noise is left in an estimate.
std::vector<Point3> error_data(std::span<const Point3> data, std::size_t border,
                               const Variogram& variogram);

/// The distance between the estimates of a variogram with anisotropy and of the most likely one
/// without, times ModelChoice::doubt. Nothing round a hole shows that grooves continue in it.
class DirectionDoubt {
public:
    DirectionDoubt(std::span<const Point3> data, const ModelChoice& choice, const Run& run);

    /// Computes an expected error for each place; zero without anisotropy. Cost: n for n data.
    [[nodiscard]] std::vector<double> at(std::span<const Point3> places, const Run& run) const;

private:
    double share_ = 0;
    std::optional<Kriging> turned_, plain_;
};

} // namespace terrane::kriging::detail
