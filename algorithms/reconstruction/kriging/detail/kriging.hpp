// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Universal kriging of heights over x and y. Source: the paper, section 5.1, equation (9); Cressie,
// Statistics for Spatial Data (1993), 3.4.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/constants.hpp>
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

/// An estimated height and its uncertainty.
struct Estimate {
    double value = 0;
    double standard_deviation = 0; ///< square root of the kriging variance
};

/// Estimates heights as weighted means of data, with weights that minimise the variance given by
/// the variogram among all that reproduce a trend, a polynomial of degree 0, 1 or 2 (universal
/// kriging): a slope is no variance, and a plane is estimated exactly. The degree is lowered if the
/// data do not determine the trend.
///
/// The estimate is the surface without the noise of single data (the nugget), at data points as
/// well. Where data are so near to each other that the system would be singular without a nugget, a
/// small term is added to its diagonal: at most 1e-6 of the mean variance of contrasts.
///
/// With at most `most_at_once` data, each estimate uses all of them, and the surface is as smooth
/// as the model. With more data, the trend is fitted by least squares and subtracted, and each
/// estimate uses `neighbours` data around it: the nearest ones of a subset that is the thinner, the
/// farther the place is from any datum.
///
/// Invariant under: the order of the data, to the bit; all else that changes neither distances nor
/// differences of heights, to rounding, with all data at once.
/// Cost: with all data at once n^3 / 3 once, n per estimate and n^2 for its standard deviation;
/// otherwise neighbours^3 / 3 each. Memory: n^2 doubles, or n.
class Kriging {
public:
    static constexpr std::size_t most_at_once = kriging::detail::constants.most_at_once;
    static constexpr std::size_t neighbours = kriging::detail::constants.neighbours;

    /// `data`: at least one; `variogram`: of the residuals of the trend. When the run is stopped,
    /// all estimates are useless.
    /// `noise_share`: of the nugget, for standard deviations.
    Kriging(std::span<const Point3> data, const Variogram& variogram, unsigned degree = 1,
            const Run& run = {}, double noise_share = 1);
    Kriging(Kriging&&) noexcept;
    ~Kriging();

    [[nodiscard]] Estimate at(double x, double y) const;

    /// Estimates many places, of which x and y are used. Where standard deviations from all data
    /// would take too long (places times data^2 above 2e10), each is the smaller one of those from
    /// 600 data and from the neighbours alone: both are larger than that from all. When the run is
    /// stopped, the remaining estimates are zero.
    [[nodiscard]] std::vector<Estimate> at(std::span<const Point3> places, const Run& run) const;

    /// Estimates places without their standard deviations; needs all data at once. Cost: n each.
    [[nodiscard]] std::vector<double> values(std::span<const Point3> places, const Run& run) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace terrane::kriging::detail
