// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Interpolates values at points of space: f(p) = sum of c_i |p - p_i|^3 plus a polynomial. Of all
// functions with these values, f minimises the energy of its third derivatives, except for those of
// the polynomial.
//
// Coordinates are scaled to a unit box; the contrasts of the polynomials make the system positive
// definite (kriging/contrasts.hpp). Cost: n^3 / 3 to fit n points, n per value. Source: the paper,
// 4.1, equation (10); Wendland (2005), 6.3 and 8.5, for the contrasts.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/run.hpp>
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

class RbfFunction {
public:
    /// Constructs the function that is 0 everywhere.
    RbfFunction() = default;

    [[nodiscard]] double operator()(const Point3& p) const;
    [[nodiscard]] Point3 gradient(const Point3& p) const;

    /// Fits a function to values at distinct points. There must be more points than the polynomial
    /// has terms, and no polynomial may vanish at all of them. `smoothing`: none: values are
    /// interpolated; otherwise the root mean square by which they are missed, by the function of
    /// least energy; 0: as is likeliest for values with noise of a Gaussian field (4/3 n^3). Errors:
    /// bad_option if the points do not satisfy this or are too near to each other; interrupted.
    static Result<RbfFunction> fitted(std::span<const Point3> points,
                                      std::span<const double> values,
                                      const RbfPolynomial& polynomial = {},
                                      std::optional<double> smoothing = {}, const Run& run = {});

private:
    /// Converts a point to u, v, w, from the middle of the box.
    [[nodiscard]] std::array<double, 3> scaled(const Point3& p) const;
    /// Sets centres and scaling, and no function yet. Returns false if all centres are equal.
    bool set_centres(std::span<const Point3> centres, const RbfPolynomial& basis);
    /// Evaluates the terms of the polynomial at a scaled point.
    void terms_at(const std::array<double, 3>& p, double* terms) const;

    Point3 middle_{};
    double scale_ = 1;              ///< half the longest side of the bounding box
    std::vector<double> x_, y_, z_; ///< centres, scaled
    std::vector<double> weights_;   ///< per centre
    RbfPolynomial basis_;
    std::vector<double> polynomial_; ///< per term: by increasing power of w, then of u, then of v
};

} // namespace terrane::rbf::detail
