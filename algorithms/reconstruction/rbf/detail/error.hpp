// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Computes the expected error of an interpolation by |p - q|^3 and a polynomial, up to a factor.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

namespace terrane::rbf::detail {

/// The power function of at most 160 of the data, half of them within a quarter of the hole's
/// radius of the border. It is the standard deviation of kriging with the same polynomial and |h|^3
/// as generalised covariance: 0 at those data, growing away from them. Each noisy datum has a
/// variance of its own, the nugget. Cost: n^3 once, n^2 per place. Source: Wendland (2005), 11.1;
/// Chiles and Delfiner (2012), 4.5, for the equivalence.
class RbfError {
public:
    /// `margin`: distance of the nearest data from the hole. `nugget`: variance of each datum.
    RbfError(const RbfData& data, const RbfPolynomial& polynomial, double margin, double nugget);

    /// Computes the power function at each place, >= 0; the factor to an expected error is
    /// RbfChoice::expected. If `measured`, the variance of another noisy datum at the place is
    /// added.
    [[nodiscard]] std::vector<double> at(std::span<const Point3> places, bool measured,
                                         const Run& run) const;

private:
    [[nodiscard]] std::size_t terms() const { return basis_.terms() - 1; }
    void terms_at(const Point3& p, double* terms) const;

    std::vector<Point3> points_; ///< scaled
    RbfPolynomial basis_;
    Point3 middle_;
    double scale_ = 1;
    double nugget_ = 0;
    std::vector<double> inverse_; ///< of the kriging system: square, for points and terms
};

} // namespace terrane::rbf::detail
