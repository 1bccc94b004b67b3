// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Static filters for points that are known only up to a radius, as constructed points are. They
// hold in any rounding mode and return std::nullopt where they cannot decide.
//
// Laws (a test carries each number):
// (1) A returned sign holds for all points within the radii.
// (2) With radius 0 a returned sign is that of orient2d or in_circle.
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <terrane/kernel/sign.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {

namespace ball_filter {

// E is at most so much of M.
constexpr double turn2d_widest = 1.0 / 8, in_circle_widest = 1.0 / 1024;
constexpr double turn2d_radius_factor = 6;     ///< of M E
constexpr double in_circle_radius_factor = 56; ///< of M^3 E
constexpr double in_circle_rounding_factor =
    static_filter::in_circle_factor + 1;   ///< of unit M^4: the radii add one rounding of the bound
constexpr double terms_factor = 14;        ///< of unit and the sum of the terms' sizes
constexpr double slopes_factor = 1.01;     ///< of E and the sum of the partial derivatives
constexpr double second_order_factor = 80; ///< of E^2 M^2
constexpr double smallest = 0x1p-1000;     ///< more than underflow can hide

} // namespace ball_filter

/// A point of a projection: each true coordinate differs from u, v by at most radius.
struct ApproximatePoint {
    double u, v, radius;
};

/// Returns Positive iff a, b, c turn left. Let M be the largest difference and E its error from the
/// radii. The radii then change the two products of differences by 2 (2 M E + E^2), at most 5 M E
/// for E <= M / 8; rounding changes them by turn2d_factor unit M^2.
inline std::optional<Sign> filtered_orient2d(const ApproximatePoint& a, const ApproximatePoint& b,
                                             const ApproximatePoint& c) {
    const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v;
    const double m =
        std::max(std::max(std::fabs(bu), std::fabs(bv)), std::max(std::fabs(cu), std::fabs(cv)));
    const double e = 2 * std::max({a.radius, b.radius, c.radius});
    using namespace static_filter;
    using namespace ball_filter;
    if (!(range_of_degree2.contains(m, m) && e <= m * turn2d_widest)) return std::nullopt;
    const double value = bu * cv - bv * cu;
    TERRANE_ASSERT_SHADOW(
        shadow::turn2d(a, b, a, c).is_near(shadow::Twin(value), turn2d_factor * unit * m * m));
    return Estimate{value, m * (turn2d_factor * unit * m + turn2d_radius_factor * e)}.sign();
}

/// Returns Positive iff d lies inside the circle through a, b, c (counterclockwise). Let M be the
/// largest difference and E its error from the radii.
/// (1) The first bound uses M alone. The radii change the 12 monomials of degree 4 in the
///     differences by 12 ((1 + E / M)^4 - 1) M^4, at most 49 M^3 E for E <= M / 1024; rounding
///     changes them by in_circle_factor unit M^4.
/// (2) Where that is too coarse, the second bound uses the sizes of the terms. Rounding adds 11
///     unit times their sum; the radii add E times the sum of the partial derivatives, and at most
///     73 E^2 M^2 for all higher orders.
/// kernel/proofs/ball_*.g are proofs of all this that Gappa checks.
inline std::optional<Sign> filtered_in_circle(const ApproximatePoint& a, const ApproximatePoint& b,
                                              const ApproximatePoint& c,
                                              const ApproximatePoint& d) {
    const double au = a.u - d.u, av = a.v - d.v, bu = b.u - d.u, bv = b.v - d.v;
    const double cu = c.u - d.u, cv = c.v - d.v;
    const double m = std::max(
        {std::fabs(au), std::fabs(av), std::fabs(bu), std::fabs(bv), std::fabs(cu), std::fabs(cv)});
    const double e = 2 * std::max({a.radius, b.radius, c.radius, d.radius});
    using namespace static_filter;
    using namespace ball_filter;
    if (!(range_of_degree4.contains(m, m) && e <= m * in_circle_widest)) return std::nullopt;
    const double la = au * au + av * av, lb = bu * bu + bv * bv, lc = cu * cu + cv * cv;
    const double value =
        la * (bu * cv - bv * cu) + lb * (cu * av - cv * au) + lc * (au * bv - av * bu);
    const double m3 = m * m * m;
    TERRANE_ASSERT_SHADOW(shadow::in_circle(a, b, c, d)
                              .is_near(shadow::Twin(value), in_circle_factor * unit * m3 * m));
    const double coarse = m3 * (in_circle_rounding_factor * unit * m + in_circle_radius_factor * e);
    if (const auto sign = Estimate{value, coarse}.sign()) return sign;
    const double bc = std::fabs(bu * cv) + std::fabs(bv * cu);
    const double ca = std::fabs(cu * av) + std::fabs(cv * au);
    const double ab = std::fabs(au * bv) + std::fabs(av * bu);
    const double sa = std::fabs(au) + std::fabs(av), sb = std::fabs(bu) + std::fabs(bv);
    const double sc = std::fabs(cu) + std::fabs(cv);
    const double terms = la * bc + lb * ca + lc * ab;
    const double slopes =
        2 * (sa * bc + sb * ca + sc * ab) + la * (sb + sc) + lb * (sc + sa) + lc * (sa + sb);
    const double mm = m * m, normal_e = e + smallest; // a subnormal one would lose the factor
    return Estimate{value, terms_factor * unit * terms + slopes_factor * normal_e * slopes +
                               second_order_factor * (e * e) * mm + (1 + mm) * smallest}
        .sign();
}

} // namespace terrane
