// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Static filters for points that are known only up to a radius: what constructed points have in
// place of doubles. Right in any rounding mode; std::nullopt where they cannot tell.
//
// Laws (a test carries each number):
// (1) A sign that is given is the sign for all points within the radii.
// (2) With radius 0 they agree with orient2d and in_circle wherever they give a sign.
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

#include <terrane/kernel/sign.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {

/// A point of a projection: each true coordinate differs from u, v by at most radius.
struct ApproximatePoint {
    double u, v, radius;
};

/// Positive iff a, b, c turn left. With M the largest difference and E its error from the radii,
/// the two products of differences are off by 2 (2 M E + E^2) from the radii, at most 5 M E for
/// E <= M / 8, and by turn2d_factor unit M^2 from rounding.
inline std::optional<Sign> filtered_orient2d(const ApproximatePoint& a, const ApproximatePoint& b,
                                             const ApproximatePoint& c) {
    const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v;
    const double m =
        std::max(std::max(std::fabs(bu), std::fabs(bv)), std::max(std::fabs(cu), std::fabs(cv)));
    const double e = 2 * std::max({a.radius, b.radius, c.radius});
    using namespace static_filter;
    if (!(range_of_degree2.contains(m, m) && e <= m / 8)) return std::nullopt;
    const double value = bu * cv - bv * cu;
    TERRANE_ASSERT_SHADOW(
        shadow::turn2d(a, b, a, c).is_near(shadow::Twin(value), turn2d_factor * unit * m * m));
    return Estimate{value, m * (turn2d_factor * unit * m + 6 * e)}.sign();
}

/// Positive iff d lies inside the circle through a, b, c (counterclockwise).
/// First with the largest difference M and its error E from the radii: 12 monomials of degree 4 in
/// the differences are off by 12 ((1 + E / M)^4 - 1) M^4 from the radii, at most 49 M^3 E for
/// E <= M / 1024, and by in_circle_factor unit M^4 from rounding. Where that is too coarse, with
/// the sizes of the terms: 11 unit times their sum from rounding, E times the sum of the partial
/// derivatives from the radii, and 72 E^2 M^2 and less for all higher orders.
inline std::optional<Sign> filtered_in_circle(const ApproximatePoint& a, const ApproximatePoint& b,
                                              const ApproximatePoint& c,
                                              const ApproximatePoint& d) {
    const double au = a.u - d.u, av = a.v - d.v, bu = b.u - d.u, bv = b.v - d.v;
    const double cu = c.u - d.u, cv = c.v - d.v;
    const double m = std::max(
        {std::fabs(au), std::fabs(av), std::fabs(bu), std::fabs(bv), std::fabs(cu), std::fabs(cv)});
    const double e = 2 * std::max({a.radius, b.radius, c.radius, d.radius});
    using namespace static_filter;
    if (!(range_of_degree4.contains(m, m) && e <= m / 1024)) return std::nullopt;
    const double la = au * au + av * av, lb = bu * bu + bv * bv, lc = cu * cu + cv * cv;
    const double value =
        la * (bu * cv - bv * cu) + lb * (cu * av - cv * au) + lc * (au * bv - av * bu);
    const double m3 = m * m * m;
    TERRANE_ASSERT_SHADOW(shadow::in_circle(a, b, c, d)
                              .is_near(shadow::Twin(value), in_circle_factor * unit * m3 * m));
    constexpr double factor = in_circle_factor + 1; // the radii round the bound once more
    if (const auto sign = Estimate{value, m3 * (factor * unit * m + 56 * e)}.sign()) return sign;
    const double bc = std::fabs(bu * cv) + std::fabs(bv * cu);
    const double ca = std::fabs(cu * av) + std::fabs(cv * au);
    const double ab = std::fabs(au * bv) + std::fabs(av * bu);
    const double sa = std::fabs(au) + std::fabs(av), sb = std::fabs(bu) + std::fabs(bv);
    const double sc = std::fabs(cu) + std::fabs(cv);
    const double terms = la * bc + lb * ca + lc * ab;
    const double slopes =
        2 * (sa * bc + sb * ca + sc * ab) + la * (sb + sc) + lb * (sc + sa) + lc * (sa + sb);
    const double smallest = (1 + m * m) * 0x1p-1000; // more than underflow can hide
    return Estimate{value,
                    14 * unit * terms + 1.01 * e * slopes + 80 * (e * e) * (m * m) + smallest}
        .sign();
}

} // namespace terrane
