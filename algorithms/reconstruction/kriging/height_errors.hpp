// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Estimates how far heights in a hole are from the truth, whatever method made them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A kriging model of the data around a hole. Given the data, the height at a place has a mean and
/// a standard deviation; so another estimate is expected to be wrong by the root of the variance
/// plus the square of its distance from that mean.
///
/// At most 300 data take part, half of them on the border, well spread. The variogram is chosen and
/// calibrated as for kriging: by restricted likelihood, and by leaving out blocks as wide as the
/// hole. Cost: 80 times n^3 for n = 128, n^3 / 3 for n = 300, and 300^2 per place.
class HeightErrors {
public:
    /// `data`: heights z over x and y, those on the border of the hole first; `radius`: of a disk
    /// with the hole's area. Useless if the run is stopped.
    HeightErrors(std::span<const Point3> data, std::size_t border, double radius, const Run& run);
    HeightErrors(HeightErrors&&) noexcept;
    HeightErrors& operator=(HeightErrors&&) noexcept;
    ~HeightErrors();

    /// Computes the expected error of each height z; NaN if there are too few data to tell.
    [[nodiscard]] std::vector<double> at(std::span<const Point3> heights, const Run& run) const;

    /// Root mean square error of blocks as wide as the hole that were left out; NaN if there were
    /// none.
    [[nodiscard]] double validated() const;

    /// Standard deviation of single data.
    [[nodiscard]] double noise() const;

    /// The main direction of the variogram, in degrees from x, counterclockwise, and its range
    /// across divided by that along: 1 without anisotropy, and for infinitely smooth surfaces,
    /// which polynomials follow in any direction.
    [[nodiscard]] std::array<double, 2> anisotropy() const;

    /// Tells whether there are enough data for expected errors: 20.
    [[nodiscard]] bool determined() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace terrane
