// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The static filters beside their polynomials in rationals, and inputs for which the exact value is
// what a test wants it to be.
#pragma once

#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/kernel/ball_filter.hpp>
#include <terrane/kernel/plane_filter.hpp>
#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gmpxx.h>

namespace test_support {

using namespace terrane;
using static_filter::Estimate, static_filter::Range, static_filter::Uv;
using Coordinates = std::vector<double>;

inline constexpr std::array modes{FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// Sets a rounding mode as long as it lives.
class Mode {
public:
    explicit Mode(int mode) { std::fesetround(mode); }
    ~Mode() { std::fesetround(FE_TONEAREST); }
    Mode(const Mode&) = delete;
    Mode& operator=(const Mode&) = delete;
};

/// A filter on points of `dimension` coordinates, and its polynomial in rationals.
struct Filter {
    unsigned points, dimension;
    Range range;
    std::function<std::optional<Estimate>(const Coordinates&)> estimate; ///< none: out of range
    std::function<mpq_class(const Coordinates&)> exact;
    /// What else makes a sign of these points, to be right as well.
    std::function<std::vector<std::optional<Sign>>(const Coordinates&)> signs;
};

inline mpq_class minus(double a, double b) {
    return mpq_class(a) - mpq_class(b);
}

inline Uv uv(const Coordinates& x, unsigned k) {
    return {x[2 * k], x[2 * k + 1]};
}
inline Point3 xyz(const Coordinates& x, unsigned k) {
    return {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
}
inline Point3 flat(const Uv& p) {
    return {p.u, p.v, 0};
}

inline std::optional<Estimate> estimate_of_turn(const Coordinates& x) {
    const static_filter::Turn2d turn(uv(x, 0), uv(x, 1), uv(x, 0), uv(x, 2));
    if (!turn.in_range()) return std::nullopt;
    return turn.estimate();
}

inline const Filter turn{
    3,
    2,
    static_filter::range_of_degree2,
    estimate_of_turn,
    [](const Coordinates& x) -> mpq_class {
        return minus(x[2], x[0]) * minus(x[5], x[1]) - minus(x[3], x[1]) * minus(x[4], x[0]);
    },
    [](const Coordinates& x) -> std::vector<std::optional<Sign>> {
        const auto ball = [&](unsigned k) { return ApproximatePoint{x[2 * k], x[2 * k + 1], 0}; };
        const Point3 a = flat(uv(x, 0)), b = flat(uv(x, 1)), c = flat(uv(x, 2));
        return {filtered_orient2d(Axis::z, a, b, c), filtered_orient2d(ball(0), ball(1), ball(2))};
    }};

inline const Filter side{4,
                         3,
                         static_filter::range_of_degree3,
                         [](const Coordinates& x) -> std::optional<Estimate> {
                             const static_filter::Plane plane(xyz(x, 0), xyz(x, 1), xyz(x, 2));
                             const auto determinant = plane.determinant(xyz(x, 3));
                             if (!determinant.in_range()) return std::nullopt;
                             return determinant.estimate();
                         },
                         [](const Coordinates& x) -> mpq_class {
                             const auto d = [&](unsigned k, unsigned i) {
                                 return minus(x[3 * k + i], x[i]);
                             };
                             return (d(1, 1) * d(2, 2) - d(1, 2) * d(2, 1)) * d(3, 0) +
                                    (d(1, 2) * d(2, 0) - d(1, 0) * d(2, 2)) * d(3, 1) +
                                    (d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0)) * d(3, 2);
                         },
                         [](const Coordinates& x) -> std::vector<std::optional<Sign>> {
                             return {PlaneFilter(xyz(x, 0), xyz(x, 1), xyz(x, 2)).side(xyz(x, 3))};
                         }};

inline const Filter circle{
    4,
    2,
    static_filter::range_of_degree4,
    [](const Coordinates& x) -> std::optional<Estimate> { // that of static_in_circle
        const double au = x[0] - x[6], av = x[1] - x[7], bu = x[2] - x[6], bv = x[3] - x[7];
        const double cu = x[4] - x[6], cv = x[5] - x[7];
        const double m = std::max({std::fabs(au), std::fabs(av), std::fabs(bu), std::fabs(bv),
                                   std::fabs(cu), std::fabs(cv)});
        if (!static_filter::range_of_degree4.contains(m, m)) return std::nullopt;
        const double value = (au * au + av * av) * (bu * cv - bv * cu) +
                             (bu * bu + bv * bv) * (cu * av - cv * au) +
                             (cu * cu + cv * cv) * (au * bv - av * bu);
        return Estimate{value,
                        static_filter::in_circle_factor * static_filter::unit * (m * m) * (m * m)};
    },
    [](const Coordinates& x) -> mpq_class {
        const auto d = [&](unsigned k, unsigned i) { return minus(x[2 * k + i], x[6 + i]); };
        const auto square = [&](unsigned k) -> mpq_class {
            return d(k, 0) * d(k, 0) + d(k, 1) * d(k, 1);
        };
        const auto minor = [&](unsigned k, unsigned l) -> mpq_class {
            return d(k, 0) * d(l, 1) - d(k, 1) * d(l, 0);
        };
        return square(0) * minor(1, 2) + square(1) * minor(2, 0) + square(2) * minor(0, 1);
    },
    [](const Coordinates& x) -> std::vector<std::optional<Sign>> {
        const auto ball = [&](unsigned k) { return ApproximatePoint{x[2 * k], x[2 * k + 1], 0}; };
        return {filtered_in_circle(ball(0), ball(1), ball(2), ball(3))};
    }};

inline Sign sign_of(const mpq_class& q) {
    return sgn(q) > 0 ? Sign::Positive : sgn(q) < 0 ? Sign::Negative : Sign::Zero;
}

inline double one_to_two(Random& random) {
    return 1 + std::ldexp(random_int(random, 0, (1 << 30) - 1), -30) +
           std::ldexp(random_int(random, 0, (1 << 22) - 1), -52);
}
inline double minus_one_to_one(Random& random) {
    return (random_int(random, 0, 1) == 0 ? 1 : -1) * (one_to_two(random) - 1);
}

/// Points for which the polynomial is nearly 0, of a size of about 1 along each axis. The last
/// coordinate of the last point but that of a circle is small, so that it can be tuned.
inline Coordinates nearly_zero(Random& random, const Filter& f) {
    Coordinates x(f.points * f.dimension);
    for (double& c : x) c = minus_one_to_one(random);
    if (&f == &turn) {
        x[2] = x[0] + (x[2] - x[0]) / 32; // what the tuned coordinate is multiplied with
        const double s = 8 * minus_one_to_one(random);
        for (unsigned i = 0; i < 2; ++i) x[4 + i] = x[i] + s * (x[2 + i] - x[i]);
    } else if (&f == &side) {
        const double s = minus_one_to_one(random), t = minus_one_to_one(random);
        for (unsigned i = 0; i < 3; ++i)
            x[9 + i] = x[i] + s * (x[3 + i] - x[i]) + t * (x[6 + i] - x[i]);
    } else {
        const double u = x[6], v = x[7], r = one_to_two(random) / 2;
        for (unsigned k = 0; k < 4; ++k) {
            const double turned = 3.1415 * minus_one_to_one(random);
            x[2 * k] = u + r * std::cos(turned);
            x[2 * k + 1] = v + r * std::sin(turned);
        }
    }
    return x;
}

/// Changes one coordinate so that the polynomial comes nearest to a value.
inline void tune(const Filter& f, Coordinates& x, const mpq_class& target) {
    double& c = x[f.points == 3 ? 5 : f.dimension == 3 ? 11 : 1];
    for (int round = 0; round < 3; ++round) {
        const double before = c;
        const mpq_class value = f.exact(x);
        c = before + std::ldexp(std::max(std::fabs(before), 0x1p-1000), -20);
        const mpq_class slope = (f.exact(x) - value) / minus(c, before);
        if (slope == 0) return;
        const mpq_class better = mpq_class(before) + (target - value) / slope;
        c = better.get_d(); // cut off: at most an ulp away
        if (!std::isfinite(c)) {
            c = before;
            return;
        }
    }
    const double found = c;
    mpq_class least = abs(f.exact(x) - target);
    for (const double other : {std::nextafter(found, -INFINITY), std::nextafter(found, INFINITY)}) {
        const double kept = std::exchange(c, other);
        const mpq_class away = abs(f.exact(x) - target);
        if (away < least)
            least = away;
        else
            c = kept;
    }
}

} // namespace test_support
