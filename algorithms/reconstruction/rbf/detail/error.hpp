// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far an interpolation by |p - q|^3 and a polynomial can be off, up to a factor. Private to
// rbf.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/function.hpp>

namespace terrane {

/// The power function of at most 160 of the data, half of them within a quarter of the hole's
/// radius of the border: the standard deviation that kriging with the same polynomial and |h|^3 as
/// generalised covariance foresees. It is 0 at those data and grows away from them; where data are
/// noisy each of them has a variance of its own, the nugget. Cost: n^3 once, n^2 per place. Source:
/// Wendland (2005), 11.1; Chiles and Delfiner (2012), 4.5, for the two being the same.
class RbfError {
public:
    /// `margin`: distance of the data nearest to the hole. `nugget`: of each of the data.
    RbfError(const RbfData& data, const RbfPolynomial& polynomial, double margin, double nugget);

    /// Per place, >= 0; times what no other part of the library knows: see RbfChoice::expected.
    /// With `measured` that of another noisy datum there.
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
    std::vector<double> inverse_; ///< of the kriging system: square, of points and terms
};

} // namespace terrane
