// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Functions of space that take given values at given points: f(p) = sum of c_i |p - p_i|^3 plus a
// polynomial. Of all functions with these values the one whose third derivatives, but for those of
// the polynomial, are least.
//
// The system is full and ill-conditioned. What is done about it: coordinates are scaled to a unit
// box; the polynomial's orthogonal complement makes the rest positive definite (Householder, then
// Cholesky); residuals are summed with MPFR in 128 bits, of kernels to 100 bits, and the solution
// refined until they no longer fall by half; the condition is estimated and all of it is reported.
// Cost: n^3 / 3 to fit n points, n per value.
// Source: the paper, 4.1, equation (10); Wendland (2005), 6.3 and 8.5, for the complement.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane {

/// The polynomial part, for the coordinates u, v, w along three axes at right angles: all monomials
/// in u and v up to a degree, and w alone; these follow a surface that is near the plane of u and
/// v. Or, `in_space`, all monomials in u, v and w up to it, for one that turns away from any plane.
/// Degree 1 is the linear part of the paper, whatever the axes.
struct RbfPolynomial {
    unsigned degree = 1;                                           ///< 1 to 8
    std::array<Point3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; ///< u, v, w: unit vectors
    bool in_space = false;

    [[nodiscard]] std::size_t terms() const {
        const std::size_t flat = (degree + 1) * (degree + 2) / 2;
        return in_space ? flat * (degree + 3) / 3 : flat + 1;
    }
};

/// How well the system was solved.
struct RbfSolution {
    std::size_t centres = 0;
    double condition = 0;      ///< estimate of the positive definite part's, in the 1-norm
    unsigned refinements = 0;  ///< steps that lowered the residual
    double first_residual = 0; ///< largest, before refinement; unit of the values
    double residual = 0;       ///< largest, of the coefficients in use; unit of the values
};

struct RbfFit;
struct RbfSetting;
struct RbfSmoothFit;

class RbfFunction {
public:
    /// 0 everywhere.
    RbfFunction() = default;

    [[nodiscard]] double operator()(const Point3& p) const;
    [[nodiscard]] Point3 gradient(const Point3& p) const;
    [[nodiscard]] std::size_t centre_count() const { return x_.size(); }

    friend Result<RbfFit> fit_rbf(std::span<const Point3>, std::span<const double>,
                                  const RbfSetting&, const Run&);
    friend Result<RbfSmoothFit> smooth_rbf(std::span<const Point3>, std::span<const Point3>,
                                           std::span<const double>, const RbfPolynomial&, double,
                                           const Run&);

private:
    /// Takes the box of the centres, and them. False where they are all the same.
    bool set_centres(std::span<const Point3> centres, const RbfPolynomial& basis);
    /// The polynomial's terms at a scaled point.
    void terms_at(const std::array<double, 3>& p, double* terms) const;
    [[nodiscard]] std::array<double, 3> scaled(const Point3& p) const;

    Point3 middle_{};
    double scale_ = 1;              ///< half the longest side of the box
    std::vector<double> x_, y_, z_; ///< centres, scaled
    std::vector<double> weights_;   ///< per centre
    RbfPolynomial basis_;
    std::vector<double> polynomial_; ///< per term: by rising power of v within rising power of
                                     ///< u within rising power of w
};

struct RbfSetting {
    RbfPolynomial polynomial;
    unsigned most_refinements = 6; ///< 0: residuals are not even computed, and NaN
};

struct RbfFit {
    RbfFunction function;
    RbfSolution solution;
};

/// The points are distinct, more than the polynomial has terms, and no polynomial is 0 at all of
/// them. Errors: bad_option where points are not as they should be, or too near to one another to
/// be told apart; interrupted.
Result<RbfFit> fit_rbf(std::span<const Point3> points, std::span<const double> values,
                       const RbfSetting& setting = {}, const Run& run = {});

struct RbfSmoothFit {
    RbfFunction function;
    double rms = 0;     ///< root mean square by which values are missed
    double freedom = 0; ///< degrees of it: terms of the polynomial to centres
    double nugget = 0;  ///< variance of a value for |h|^3 as generalised covariance; unit cubed
};

/// A function with these centres that takes the values nearly (rbf_smooth.cpp): of all that miss
/// them by `rms`, root mean square, the one whose third derivatives are least. rms 0: the one that
/// predicts each value best from the others, by generalised cross-validation. The polynomial alone
/// where it misses less than that. Points may be more than centres, and need not be among them.
/// Cost: n^2 for each point and 10 n^3, n centres. Errors: as fit_rbf. Source: Wahba (1990), 4.
Result<RbfSmoothFit> smooth_rbf(std::span<const Point3> centres, std::span<const Point3> points,
                                std::span<const double> values, const RbfPolynomial& polynomial,
                                double rms, const Run& run = {});

} // namespace terrane
