// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The linear system of a graph g(u, v): a sum of kernels of the distance in the plane and a
// polynomial.
//
// Kernels are generalised covariances, so g is also an estimate by intrinsic kriging, and the
// system knows its variance. Source: Chiles and Delfiner (2012), 4.5 to 4.7.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rbf::detail {

/// The terms of g.
struct HeightForm {
    RbfKernel kernel = RbfKernel::cubic;
    unsigned degree = 1;
    double nugget = 0; ///< variance of single data, in factors of the kernel
};

/// Returns the number of terms of a polynomial in u and v.
constexpr Eigen::Index terms_of(unsigned degree) {
    return static_cast<Eigen::Index>((degree + 1) * (degree + 2) / 2);
}

/// The contrasts of some data, and the kernel between them. Places and data have x = u, y = v and
/// z = w. Cost: n^2 m for n data and m terms; n^3 / 3 to factorise.
class HeightSystem {
public:
    HeightSystem(std::span<const Point3> data, RbfKernel kernel, unsigned degree);

    /// Tells whether the data determine the polynomial.
    [[nodiscard]] bool determined() const;
    /// Tells whether the data are the polynomial up to rounding.
    [[nodiscard]] bool polynomial_only() const;
    [[nodiscard]] Eigen::MatrixXd between_contrasts() const;
    [[nodiscard]] Eigen::VectorXd contrasts() const;

    /// Factorises. Returns false if the matrix is not positive definite or the run is stopped. The
    /// functions below need the factors.
    bool factorise(double nugget, const Run& run);
    /// The weights of the kernels.
    [[nodiscard]] Eigen::VectorXd weights() const;
    /// The factors of the polynomial's terms.
    [[nodiscard]] Eigen::VectorXd polynomial() const;
    /// The matrix P for which P z are the weights.
    [[nodiscard]] Eigen::MatrixXd projection() const;
    /// Returns a lower bound of the condition number: the squared ratio of the largest to the least
    /// diagonal entry of the Cholesky factor.
    [[nodiscard]] double condition() const;
    /// Estimates g, without the noise of the data. Cost: n per place.
    [[nodiscard]] std::vector<double> values(std::span<const Point3> places) const;
    /// Computes the standard deviations of such estimates, for a kernel with the factor 1, if the
    /// noise of the data is this share of the nugget. Cost: n^2 per place.
    [[nodiscard]] std::vector<double> deviations(std::span<const Point3> places, double noise_share,
                                                 const Run& run) const;
    [[nodiscard]] std::size_t size() const { return data_.size(); }
    [[nodiscard]] std::span<const Point3> data() const { return data_; }

private:
    [[nodiscard]] Eigen::VectorXd solved() const;
    [[nodiscard]] std::vector<double> some_deviations(std::span<const Point3> places,
                                                      double noise_share) const;

    std::vector<Point3> data_;
    RbfKernel kernel_;
    unsigned degree_;
    double nugget_ = 0;
    Eigen::VectorXd heights_; ///< rotated: m for the polynomial, then the contrasts
    Eigen::MatrixXd kernels_; ///< rotated
    Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
    Eigen::MatrixXd factor_;
    Eigen::Index m_ = 0;
};

} // namespace terrane::rbf::detail
