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

// Evaluates stages two to four. `polynomial` is generic over the number type. Stage one decides
// most calls in some 50 instructions; it stays that short if this function is not inlined.
template <class Polynomial>
[[gnu::noinline, gnu::cold]] Sign filtered(const Polynomial& polynomial) {
    {
        const UpwardRounding guard;
        if (const auto sign = certain_sign(guard, polynomial(Interval{}))) {
            ++predicate_counts().interval;
            return *sign;
        }
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
    return filtered([&]<class N>(N) {
        return polynomial::orient3d(cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                    cartesian<N>(d));
    });
}

__attribute__((no_stack_protector)) Sign turn2d(Axis axis, const Point3& a, const Point3& b,
                                                const Point3& c, const Point3& d) {
    if (const auto sign =
            static_turn2d(project(axis, a), project(axis, b), project(axis, c), project(axis, d))) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return filtered([&]<class N>(N) {
        return polynomial::turn2d(axis, cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                  cartesian<N>(d));
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
    return filtered([&]<class N>(N) {
        return polynomial::in_circle(axis, cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                     cartesian<N>(d));
    });
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
        return filtered([&]<class N>(N) {
                   const auto n = normal<N>(a, b, c);
                   return compare_squares(pick(n, first), pick(n, second));
               }) == Sign::Positive;
    };
    const Axis best = longer(Axis::x, Axis::z) ? Axis::x : Axis::z;
    return longer(Axis::y, best) ? Axis::y : best;
}

} // namespace terrane
