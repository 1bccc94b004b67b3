// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Linear algebra of contrasts: combinations of data that no polynomial of the trend changes. What
// Eigen factorises for kriging is compiled here alone.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include <terrane/algorithms/core/run.hpp>

namespace terrane {

/// An orthogonal basis of the data, in which the first numbers are those of the trend, and the others
/// contrasts (Householder).
class Contrasts {
public:
    /// `terms`: of the trend, one row per datum; no more columns than rows.
    explicit Contrasts(Eigen::MatrixXd terms);

    /// Number of terms of the trend.
    [[nodiscard]] Eigen::Index terms() const { return factors_.size(); }
    /// Tells whether the data determine the trend.
    [[nodiscard]] bool determined() const;
    /// Expresses data, or columns of data, in the basis. Cost: a few operations per number.
    void apply(Eigen::VectorXd& data) const { apply_to(data.data()); }
    void apply(Eigen::MatrixXd& columns) const;
    /// Expresses a symmetric matrix between data in the basis.
    void apply_twice(Eigen::MatrixXd& symmetric) const;
    /// Turns numbers in the basis into data.
    void undo(Eigen::VectorXd& numbers) const { undo_to(numbers.data()); }
    void undo(Eigen::MatrixXd& columns) const;
    /// Finds the factors of the terms whose sum has these first numbers in the basis.
    [[nodiscard]] Eigen::VectorXd trend_of(const Eigen::VectorXd& numbers) const;
    /// Finds, for columns of terms at places, the first numbers of data weights that reproduce them.
    void reproduce(Eigen::MatrixXd& terms) const;

private:
    void apply_to(double* data) const;
    void undo_to(double* data) const;

    Eigen::MatrixXd vectors_; ///< of the reflections, below the diagonal; above: the triangle
    Eigen::VectorXd factors_; ///< of the reflections
};

/// Nugget and sill of a kernel that are most likely.
struct LikelyNugget {
    double likelihood = -HUGE_VAL; ///< its logarithm, up to a constant of the data
    double sill = 0;               ///< factor of the kernel
    double nugget = 0;             ///< variance of single data
};

/// Holds the covariance matrix of contrasts in a basis in which it is tridiagonal. The likelihood of
/// another nugget then costs O(n), for trends of all degrees together. Cost of the basis: 4/3 n^3.
class TridiagonalKernel {
public:
    /// `trends`: how many of the first contrasts belong to each trend, ascending, at most three
    /// numbers up to 5.
    TridiagonalKernel(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& contrasts,
                      std::vector<Eigen::Index> trends);

    /// Finds, for each trend, the nugget and the sill with the largest restricted likelihood
    /// (Harville 1977).
    [[nodiscard]] std::vector<LikelyNugget> most_likely() const;
    /// Finds the nugget, for a sill of 1, with which this sum of squares is left of the contrasts
    /// of the first trend, or the largest that is tried. Needs a first trend of 0.
    [[nodiscard]] double nugget_leaving(double squares) const;

private:
    static constexpr int most_columns = 8;
    using Columns = Eigen::Matrix<double, most_columns, 1>;

    [[nodiscard]] std::vector<LikelyNugget> profile(double nugget) const;

    std::vector<Eigen::Index> trends_;
    Eigen::VectorXd diagonal_, beside_;
    std::vector<Columns> rows_; ///< per number of the basis: of the trends' contrasts, then of the
                                ///< data without those of each trend
    double scale_ = 0;
};

/// Replaces the lower triangle of a symmetric matrix by its Cholesky factor, in panels of 128
/// columns; looks at the stop token before each. Returns whether the matrix is positive definite
/// and the run was not stopped. Cost: n^3 / 3.
bool cholesky(Eigen::MatrixXd& matrix, const Run& run);

/// Divides columns by a Cholesky factor from the left, and by its transpose.
void divide_by_factor(const Eigen::MatrixXd& factor, Eigen::MatrixXd& columns);
void divide_by_transposed(const Eigen::MatrixXd& factor, Eigen::MatrixXd& columns);

/// Computes the product of the transpose of a matrix and itself.
Eigen::MatrixXd squared(const Eigen::MatrixXd& matrix);

/// Inverts a Cholesky factor. Cost: n^3 / 3.
Eigen::MatrixXd inverse_of_factor(const Eigen::MatrixXd& factor);

} // namespace terrane
