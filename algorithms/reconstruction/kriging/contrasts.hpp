// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Linear algebra of contrasts: combinations of data that no polynomial of the trend changes.
// Kriging and radial basis functions share it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// Nugget and sill of a kernel that are most likely.
struct LikelyNugget {
    double likelihood = -HUGE_VAL; ///< its logarithm, up to a constant of the data
    double sill = 0;               ///< factor of the kernel
    double nugget = 0;             ///< variance of single data
};

/// The hypothesis that contrasts are noise, and the surface the trend.
struct NoiseAlone {
    explicit NoiseAlone(const Eigen::VectorXd& contrasts);

    /// Computes how probable it is that the trend leaves a surface: by Akaike's criterion,
    /// the most likely kernel must be more likely by a factor of e for each of its parameters.
    [[nodiscard]] double probability_of(const LikelyNugget& likely, double parameters) const;

    double likelihood = -HUGE_VAL; ///< its logarithm, up to the same constant
    double variance = 0;           ///< of single data
    double price = 0;              ///< of a parameter, in logarithms of likelihoods
};

/// Holds the covariance matrix of contrasts in a basis in which it is tridiagonal. The likelihood of
/// another nugget then costs O(n). Cost of the basis: 4/3 n^3.
class TridiagonalKernel {
public:
    TridiagonalKernel(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& contrasts);

    /// Finds the nugget, at most `most_nugget`, and the sill with the largest restricted likelihood
    /// (Harville 1977).
    [[nodiscard]] LikelyNugget most_likely(double most_nugget) const;
    /// Computes the norm of the residual of a fit, for a nugget in sills.
    [[nodiscard]] double missed(double nugget) const;
    /// Computes the degrees of freedom that a fit uses beyond the trend, for a nugget in sills.
    [[nodiscard]] double freedom(double nugget) const;
    /// Mean of the diagonal.
    [[nodiscard]] double scale() const { return scale_; }

private:
    struct Profile {
        double likelihood = -HUGE_VAL;
        double sill = 0;
    };
    [[nodiscard]] Profile profile(double nugget) const;

    Eigen::VectorXd diagonal_, beside_, values_;
    double scale_ = 0;
};

/// Replaces the lower triangle of a symmetric matrix by its Cholesky factor, in panels of 128
/// columns; looks at the stop token before each. Returns whether the matrix is positive definite
/// and the run was not stopped. Cost: n^3 / 3.
bool cholesky(Eigen::MatrixXd& matrix, const Run& run);

/// Selects `count` points, each as far as possible from those before it in x and y; the first one
/// is farthest from the mean. Of points as far as each other the one farthest from the mean height
/// is taken, so that neither the order of the points decides nor the direction of the axes.
std::vector<std::uint32_t> well_spread_in_plane(std::span<const Point3> points, std::size_t count);

/// Points from which a covariance can be told.
struct SpreadPairs {
    std::vector<std::uint32_t> chosen; ///< well-spread points, then the neighbours of some
    double gap = 0;                    ///< median distance of those neighbours; 0 if there are none
};

/// Selects `count` well-spread points and, for the first `pairs` of them, the nearest one that
/// is not taken: without such pairs nobody could tell noise from a surface that is rough within the
/// distance of well-spread points. Of equally near ones, that farthest from the mean height is
/// taken.
SpreadPairs well_spread_pairs(std::span<const Point3> points, std::size_t count, std::size_t pairs);

/// Computes the standard deviation of the error that rounding to doubles adds to estimates of
/// heights z with a trend of this degree.
double rounding_of(std::span<const Point3> data, unsigned degree = 1);

} // namespace terrane
