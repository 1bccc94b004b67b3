// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Ordinary kriging of heights over x and y.
// Source: the paper, section 5.1, equation (9); Cressie, Statistics for Spatial Data (1993), 3.2.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/detail/variogram.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// A height and how far off it can be expected to be.
struct Estimate {
    double value = 0;
    double standard_deviation = 0; ///< square root of the kriging variance
};

/// Estimates heights as weighted means of data: weights that sum to one and make the variance by
/// the variogram least. A trend by least squares, a polynomial of degree 1 or 2, is taken off the
/// data first and put back onto estimates: a slope is no variance, and a plane is estimated as that
/// plane.
///
/// What is estimated is the surface without the noise of single data (the nugget), also at data
/// points. Data so near to each other that they can't be told apart without a nugget keep the
/// systems solvable by a small addition to the diagonal: at most 1e-6 of the sill.
///
/// With at most `most_at_once` data every estimate uses all of them, and the surface is as smooth
/// as the model. With more, each uses `neighbours` data round it: the nearest among data thinned
/// out the more, the farther the place is from any.
///
/// Cost: all data at once: n^3 / 3 once, n per estimate, n^2 for its deviation; else
/// neighbours^3 / 3 each. Memory: n^2 doubles, or n.
class Kriging {
public:
    static constexpr std::size_t most_at_once = 700;
    static constexpr std::size_t neighbours = 40;

    /// `data`: at least one; `variogram` of the data with the trend taken off.
    Kriging(std::span<const Point3> data, const Variogram& variogram, unsigned degree = 1);
    Kriging(Kriging&&) noexcept;
    ~Kriging();

    [[nodiscard]] Estimate at(double x, double y) const;

    /// The same at many places, by x and y. Where deviations from all data would take too long
    /// (places times data^2 above 4e9) they come from the neighbours alone, which makes them
    /// larger. Stops early, with zeros left, when the run is stopped.
    [[nodiscard]] std::vector<Estimate> at(std::span<const Point3> places, const Run& run) const;

    /// Leaves out one datum at a time, at most `most` of them evenly chosen, and estimates it from
    /// its neighbours among the others.
    struct Validation {
        std::size_t count = 0;
        double error = 0;    ///< root mean square of what was missed
        double expected = 0; ///< root mean square of the deviations, with the nugget
    };
    [[nodiscard]] Validation validate(std::size_t most) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The data with the trend's heights taken off. `degree`: 0, 1 or 2.
std::vector<Point3> residuals(std::span<const Point3> data, unsigned degree);

} // namespace terrane
