// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The system of universal kriging, and the likelihood of a variogram.
//
// Both work with contrasts: combinations of the data that no polynomial of the trend changes
// (Householder), so that they need no covariances but only the variogram, and long ranges do no
// harm. Source: Chiles and Delfiner (2012), 3.4 and 4.6; Harville (1977) for the likelihood.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/kriging/contrasts.hpp>
#include <terrane/algorithms/reconstruction/kriging/variogram.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::kriging::detail {

inline constexpr unsigned highest_degree = 2;

/// Number of terms of a polynomial in x and y.
constexpr Eigen::Index terms_of(unsigned degree) {
    return (static_cast<Eigen::Index>(degree) + 1) * (static_cast<Eigen::Index>(degree) + 2) / 2;
}

/// The terms of a polynomial in x and y, those of lower degree first, which are shifted and scaled to [-1, 1].
class TrendTerms {
public:
    /// The degree, at most 2, is lowered until the data determine the polynomial.
    TrendTerms(std::span<const Point3> data, unsigned degree);

    [[nodiscard]] Eigen::Index size() const { return size_; }
    [[nodiscard]] std::array<double, 2> centre() const { return {x0_, y0_}; }
    [[nodiscard]] Eigen::VectorXd at(double x, double y) const;
    /// One row per datum.
    [[nodiscard]] Eigen::MatrixXd matrix(std::span<const Point3> data) const;

private:
    double x0_ = 0, y0_ = 0, scale_ = 0;
    Eigen::Index size_ = 1;
};

/// The heights of data.
Eigen::VectorXd heights_of(std::span<const Point3> data);

/// The diagonal of the bounding box of data in x and y.
double flat_extent_of(std::span<const Point3> data);

/// A height and its standard deviation.
struct Estimate {
    double value = 0;
    double standard_deviation = 0;
};

/// The factorised system of universal kriging for all data at once.
class System {
public:
    /// Stops early, and is not ready then, if the run is stopped.
    System(std::span<const Point3> data, const Variogram& model, unsigned degree,
           const Run& run = {});

    [[nodiscard]] bool ready() const { return ready_; }
    /// The sum of squares of the contrasts in what the model expects of it: 1, but for luck, if it
    /// holds.
    [[nodiscard]] double misfit() const { return misfit_; }
    /// Estimates places in blocks, with the square roots of the kriging variances if wanted.
    [[nodiscard]] std::vector<Estimate> at(std::span<const Point3> places, bool deviations) const;
    /// The matrix P for which P z are the weights of the data: if data B are left out, they are
    /// missed by inverse(P_BB) (P z)_B, with these variances and covariances: inverse(P_BB).
    [[nodiscard]] Eigen::MatrixXd projection() const;
    [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }

private:
    using Place = std::array<double, 2>;

    [[nodiscard]] Place place(double x, double y) const;
    [[nodiscard]] double kernel(const Place& p, const Place& q) const;
    [[nodiscard]] Eigen::MatrixXd kernels() const;
    bool factorise(const Eigen::MatrixXd& rotated, const Run& run);

    Variogram model_;
    double cosine_ = 1, sine_ = 0;
    TrendTerms terms_;
    std::vector<Place> places_; ///< of the data, turned and stretched so that distances are those
                                ///< of the variogram
    Contrasts contrasts_;       ///< of the terms at the data
    Eigen::MatrixXd top_;       ///< kernels between trend and all rotated data
    Eigen::MatrixXd factor_;    ///< lower triangle, of the contrasts
    Eigen::VectorXd weights_, polynomial_;
    double misfit_ = 0;
    bool ready_ = false;
};

/// The variogram of one shape with the largest likelihood.
struct Likely {
    double likelihood = -HUGE_VAL; ///< its logarithm
    Variogram variogram;           ///< with nugget and sill
    unsigned degree = 0;           ///< of the trend
};

/// Likelihood of variograms for given data and trends of each degree that the data determine. Factors
/// of a trend, but for that of degree 0, are spread over the variance of the heights. So trends of
/// several degrees compare.
class Likelihood {
public:
    explicit Likelihood(std::span<const Point3> data);

    /// Finds nugget and sill of this shape (its model, range, exponent, angle and ratio) that are
    /// most likely, with each trend that the model allows. Cost: 4/3 n^3, by a tridiagonal form that
    /// serves all ratios of nugget and sill, and all trends.
    [[nodiscard]] std::vector<Likely> at(const Variogram& shape) const;
    /// The likelihood of noise about each trend, and no field. Of data that are a trend up to
    /// rounding, this one alone, without noise.
    [[nodiscard]] std::vector<Likely> of_noise() const;

    /// Extent of the data: the diagonal of their bounding box.
    [[nodiscard]] double extent() const { return extent_; }

private:
    /// Number of contrasts that the trend of a degree leaves.
    [[nodiscard]] Eigen::Index left_by(unsigned degree) const;
    /// The part of all logarithms that does not depend on the model.
    [[nodiscard]] double constant_of(unsigned degree) const;

    std::vector<Point3> data_;
    TrendTerms terms_; ///< of the highest degree; those of lower ones come first
    Contrasts basis_;
    Eigen::VectorXd numbers_; ///< the heights in the basis
    double extent_ = 0;
    double spread_ = 0;   ///< logarithm of 2 pi times the sum of squared heights
    double rounding_ = 0; ///< contrasts up to this are rounding
};

} // namespace terrane::kriging::detail
