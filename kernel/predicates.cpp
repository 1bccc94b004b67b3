// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/predicates.hpp>

#include <algorithm>
#include <cmath>

#include <terrane/kernel/double_double.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/static_filter_bounds.hpp>

namespace terrane {
namespace {

using polynomial::cartesian;
using static_filter::in_circle_factor, static_filter::projection_axis_factor, static_filter::unit;
using static_filter::project, static_filter::Uv;

double largest(double a, double b, double c) {
    return std::max({std::fabs(a), std::fabs(b), std::fabs(c)});
}

std::optional<Sign> static_orient3d(const Point3& a, const Point3& b, const Point3& c,
                                    const Point3& d) {
    const static_filter::Plane plane(a, b, c);
    const auto determinant = plane.determinant(d);
    if (determinant.is_zero()) return Sign::Zero;
    if (!determinant.in_range()) return std::nullopt;
    return determinant.estimate().sign();
}

std::optional<Sign> static_turn2d(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    const static_filter::Turn2d turn(a, b, c, d);
    if (turn.is_zero()) return Sign::Zero;
    if (!turn.in_range()) return std::nullopt;
    return turn.estimate().sign();
}

std::optional<Sign> static_in_circle(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    const double au = a.u - d.u, av = a.v - d.v, bu = b.u - d.u, bv = b.v - d.v;
    const double cu = c.u - d.u, cv = c.v - d.v;
    const double m = std::max(largest(au, bu, cu), largest(av, bv, cv));
    if (m == 0) return Sign::Zero;
    if (!static_filter::range_of_degree4.contains(m, m)) return std::nullopt;
    const double value = (au * au + av * av) * (bu * cv - bv * cu) +
                         (bu * bu + bv * bv) * (cu * av - cv * au) +
                         (cu * cu + cv * cv) * (au * bv - av * bu);
    const static_filter::Estimate e{value, in_circle_factor * unit * (m * m) * (m * m)};
    TERRANE_ASSERT_SHADOW(shadow::in_circle(a, b, c, d).is_near(shadow::Twin(value), e.bound));
    return e.sign();
}

// Finds the axis along which the normal is longest, if it is so by more than the rounding error.
// Each coordinate of the normal is a minor of differences: (5) of static_filter_bounds.hpp.
std::optional<Axis> static_projection_axis(const Point3& a, const Point3& b, const Point3& c) {
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
    const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    const double m = std::max(largest(bx, by, bz), largest(cx, cy, cz));
    if (!static_filter::range_of_degree2.contains(m, m)) return std::nullopt;
    const double x = std::fabs(by * cz - bz * cy), y = std::fabs(bz * cx - bx * cz),
                 z = std::fabs(bx * cy - by * cx);
    const double bound = projection_axis_factor * unit * m * m;
    if (x > y + bound && x > z + bound) return Axis::x;
    if (y > z + bound && y > x + bound) return Axis::y;
    if (z > x + bound && z > y + bound) return Axis::z;
    return std::nullopt;
}

/// Whether x + y and z + w are the same number. Two doubles hold each sum exactly (Knuth).
bool are_equal_sums(double x, double y, double z, double w) {
    if (x + y != z + w) return false; // equal numbers are rounded alike, in any mode
    const ToNearest mode;
    const auto rest = [](double a, double b) {
        const double sum = a + b, part = sum - a;
        return (a - (sum - part)) + (b - part);
    };
    return in_twofold([&] { return x + y == z + w && rest(x, y) == rest(z, w); });
}
bool are_equal_sums(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    return are_equal_sums(a.x, b.x, c.x, d.x) && are_equal_sums(a.y, b.y, c.y, d.y) &&
           are_equal_sums(a.z, b.z, c.z, d.z);
}
bool are_equal_sums(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    return are_equal_sums(a.u, b.u, c.u, d.u) && are_equal_sums(a.v, b.v, c.v, d.v);
}

/// Whether one of three points is in the middle of the others.
template <class P>
bool has_middle(const P& a, const P& b, const P& c) {
    return are_equal_sums(a, a, b, c) || are_equal_sums(b, b, a, c) || are_equal_sums(c, c, a, b);
}

/// Whether the points are in one plane, as one is in the middle of two others, or four are the corners of
/// a parallelogram.
bool are_flat(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    return has_middle(a, b, c) || has_middle(a, b, d) || has_middle(a, c, d) ||
           has_middle(b, c, d) || are_equal_sums(a, b, c, d) || are_equal_sums(a, c, b, d) ||
           are_equal_sums(a, d, b, c);
}

/// Whether directions a b and c d are parallel, as they are equal or opposite, or as a, which is c, b and d
/// have a point in the middle.
bool are_parallel(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    return are_equal_sums(a, d, b, c) || are_equal_sums(a, c, b, d) ||
           (a == c && has_middle(a, b, d));
}

/// Stands for a test that tells nothing.
constexpr auto not_known = [] { return false; };

/// Evaluates the stages after intervals. `is_zero()`: whether the polynomial is known to be zero. Of exact
/// zeros, which only the last stage would tell, most come from regular grids, where it is.
template <class Polynomial, class IsZero>
[[gnu::noinline]] Sign precise_sign(const Polynomial& polynomial, const IsZero& is_zero) {
    if (is_zero()) {
        ++predicate_counts().exact;
        return Sign::Zero;
    }
    {
        const ToNearest mode;
        if (const auto sign = in_twofold([&] { return polynomial(DoubleDouble{}).sign(); })) {
            ++predicate_counts().interval;
            return *sign;
        }
    }
    ++predicate_counts().exact;
    return exact_sign(polynomial(Exact{}));
}

// Evaluates stages two to four. `polynomial` is generic over the number type. Stage one decides
// most calls in some 50 instructions; it stays that short if this function is not inlined.
template <class Polynomial, class IsZero>
[[gnu::noinline, gnu::cold]] Sign filtered(const Polynomial& polynomial, const IsZero& is_zero) {
    {
        const UpwardRounding guard;
        if (const auto sign = certain_sign(guard, polynomial(Interval{}))) {
            ++predicate_counts().interval;
            return *sign;
        }
    }
    return precise_sign(polynomial, is_zero);
}

template <class N>
polynomial::Vector<N> normal(const Point3& a, const Point3& b, const Point3& c) {
    using namespace polynomial;
    const auto origin = cartesian<N>(a);
    return cross(difference(cartesian<N>(b), origin), difference(cartesian<N>(c), origin));
}

// Compares coordinates of a normal by size: positive iff |first| > |second|.
template <class N>
N compare_squares(const N& first, const N& second) {
    return first * first - second * second;
}

} // namespace

std::optional<Sign> filtered_orient2d(Axis axis, const Point3& a, const Point3& b,
                                      const Point3& c) {
    const Uv p = project(axis, a);
    return static_turn2d(p, project(axis, b), p, project(axis, c));
}

// Stage one has no arrays, so its stack needs no protection. The others protect theirs.
__attribute__((no_stack_protector)) Sign orient3d(const Point3& a, const Point3& b, const Point3& c,
                                                  const Point3& d) {
    if (const auto sign = static_orient3d(a, b, c, d)) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return filtered(
        [&]<class N>(N) {
            return polynomial::orient3d(cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                        cartesian<N>(d));
        },
        [&] { return are_flat(a, b, c, d); });
}

__attribute__((no_stack_protector)) Sign turn2d(Axis axis, const Point3& a, const Point3& b,
                                                const Point3& c, const Point3& d) {
    if (const auto sign =
            static_turn2d(project(axis, a), project(axis, b), project(axis, c), project(axis, d))) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return filtered(
        [&]<class N>(N) {
            return polynomial::turn2d(axis, cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                      cartesian<N>(d));
        },
        [&] {
            return are_parallel(project(axis, a), project(axis, b), project(axis, c),
                                project(axis, d));
        });
}

Sign orient2d(Axis axis, const Point3& a, const Point3& b, const Point3& c) {
    return turn2d(axis, a, b, a, c);
}

__attribute__((no_stack_protector)) Sign in_circle(Axis axis, const Point3& a, const Point3& b,
                                                   const Point3& c, const Point3& d) {
    if (const auto sign = static_in_circle(project(axis, a), project(axis, b), project(axis, c),
                                           project(axis, d))) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return filtered(
        [&]<class N>(N) {
            return polynomial::in_circle(axis, cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                         cartesian<N>(d));
        },
        not_known);
}

bool collinear(const Point3& a, const Point3& b, const Point3& c) {
    return orient2d(Axis::z, a, b, c) == Sign::Zero && orient2d(Axis::x, a, b, c) == Sign::Zero &&
           orient2d(Axis::y, a, b, c) == Sign::Zero;
}

Axis projection_axis(const Point3& a, const Point3& b, const Point3& c) {
    if (const auto axis = static_projection_axis(a, b, c)) return *axis;
    const auto longer = [&](Axis first, Axis second) {
        const auto pick = []<class N>(const polynomial::Vector<N>& n, Axis k) -> const N& {
            return k == Axis::x ? n.x : k == Axis::y ? n.y : n.z;
        };
        return filtered(
                   [&]<class N>(N) {
                       const auto n = normal<N>(a, b, c);
                       return compare_squares(pick(n, first), pick(n, second));
                   },
                   not_known) == Sign::Positive;
    };
    const Axis best = longer(Axis::x, Axis::z) ? Axis::x : Axis::z;
    return longer(Axis::y, best) ? Axis::y : best;
}

} // namespace terrane
