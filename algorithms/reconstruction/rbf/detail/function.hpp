// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Interpolates values at points of space: f(p) = sum of c_i |p - p_i|^3 plus a polynomial. Of all
// functions with these values, f minimises the energy of its third derivatives, except for those of
// the polynomial.
//
// The system is dense and ill-conditioned. Therefore coordinates are scaled to a unit box; the
// orthogonal complement of the polynomials makes the remaining system positive definite
// (Householder, then Cholesky); residuals are summed in about 106 bits, with kernels to 100 bits,
// and the solution is refined until they no longer halve; the condition is estimated, and all
// of it is reported. Cost: n^3 / 3 to fit n points, n per value. Source: the paper, 4.1, equation
// (10); Wendland (2005), 6.3 and 8.5, for the complement.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::rbf::detail {

/// The polynomial part, in coordinates u, v, w along three orthogonal axes: all monomials in u and
/// v up to a degree, and w, for a surface near the plane of u and v. If `in_space`, all monomials
/// in u, v and w, for a surface that turns away from any plane. Degree 1 is the linear part of the
/// paper, whatever the axes.
struct RbfPolynomial {
    unsigned degree = 1;                                           ///< 1 to 8
    std::array<Point3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; ///< u, v, w: unit vectors
    bool in_space = false;

    [[nodiscard]] std::size_t terms() const {
        const std::size_t flat = (degree + 1) * (degree + 2) / 2;
        return in_space ? flat * (degree + 3) / 3 : flat + 1;
    }
};

struct RbfFit;
struct RbfSetting;
struct RbfSmoothFit;

class RbfFunction {
public:
    /// Constructs the function that is 0 everywhere.
    RbfFunction() = default;

    [[nodiscard]] double operator()(const Point3& p) const;
    [[nodiscard]] Point3 gradient(const Point3& p) const;
    /// The unit of u, v, w, half the longest side of the box of the centres.
    [[nodiscard]] double unit() const { return scale_; }
    /// Converts a point to u, v, w, from the middle of the box.
    [[nodiscard]] std::array<double, 3> scaled(const Point3& p) const;

    /// Sets centres and scaling, and no function yet. Returns false if all centres are equal.
    bool set_centres(std::span<const Point3> centres, const RbfPolynomial& basis);

    friend Result<RbfFit> fit_rbf(std::span<const Point3>, std::span<const double>,
                                  const RbfSetting&, const Run&);
    friend Result<RbfSmoothFit> smooth_rbf(std::span<const Point3>, std::span<const Point3>,
                                           std::span<const double>, const RbfPolynomial&, double,
                                           const Run&);

private:
    /// Evaluates the terms of the polynomial at a scaled point.
    void terms_at(const std::array<double, 3>& p, double* terms) const;

    Point3 middle_{};
    double scale_ = 1;              ///< half the longest side of the bounding box
    std::vector<double> x_, y_, z_; ///< centres, scaled
    std::vector<double> weights_;   ///< per centre
    RbfPolynomial basis_;
    std::vector<double> polynomial_; ///< per term: by increasing power of w, then of u, then of v
};

struct RbfSetting {
    RbfPolynomial polynomial;
    unsigned most_refinements = 6; ///< 0: residuals are not computed, and NaN
};

struct RbfFit {
    RbfFunction function;
    RbfSolution solution;
};

/// Fits a function to values at distinct points. There must be more points than the polynomial has
/// terms, and no polynomial may vanish at all of them. Errors: bad_option if the points do not
/// satisfy this or are too near to each other; interrupted.
Result<RbfFit> fit_rbf(std::span<const Point3> points, std::span<const double> values,
                       const RbfSetting& setting = {}, const Run& run = {});

struct RbfSmoothFit {
    RbfFunction function;
    double rms = 0;     ///< root mean square error
    double freedom = 0; ///< degrees of freedom: from the terms of the polynomial to the number of
                        ///< centres
    double nugget = 0;  ///< variance of a value for |h|^3 as generalised covariance; unit cubed
};

/// Fits a function with these centres to values approximately (defined in smooth.cpp): of all
/// functions with the root mean square error `rms`, the one of least energy. rms 0: the one that
/// predicts each value best from the others, by generalised cross-validation. The polynomial alone
/// if its error is less than that. There may be more points than centres, and centres need not be
/// points. Cost: n^2 for each point and 10 n^3, for n centres. Errors: as fit_rbf(). Source: Wahba
/// (1990), 4.
Result<RbfSmoothFit> smooth_rbf(std::span<const Point3> centres, std::span<const Point3> points,
                                std::span<const double> values, const RbfPolynomial& polynomial,
                                double rms, const Run& run = {});

} // namespace terrane::rbf::detail
