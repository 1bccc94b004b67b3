// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/kernel/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane {
namespace {

using polynomial::cartesian;

// One operation in any rounding mode: |computed - true| <= unit |true|.
constexpr double unit = std::numeric_limits<double>::epsilon();

// Products of the coordinate differences must neither underflow nor overflow for the bounds to
// hold: all products of degree 2, 3, 4 of numbers in these ranges are normal.
constexpr double low2 = 0x1p-480;
constexpr double low3 = 0x1p-320;
constexpr double low4 = 0x1p-240;
constexpr double high2 = 0x1p+500;
constexpr double high3 = 0x1p+330;
constexpr double high4 = 0x1p+250;

std::optional<Sign> beyond(double value, double bound) {
    if (value > bound) return Sign::Positive;
    if (value < -bound) return Sign::Negative;
    return std::nullopt;
}

double largest(double a, double b, double c) {
    return std::max({std::fabs(a), std::fabs(b), std::fabs(c)});
}

// Rounding: each difference is off by unit, each product adds unit; a minor of two products of size
// A B is off by at most 2 (3 unit) A B + 2 unit A B = 8 unit A B; times a third difference
// (2 A B C)(2 unit) more: 12 unit A B C; three of them 36, two additions (4 + 6) unit A B C. 46 in
// all, 48 covers the terms of second order and the rounding of the bound itself.
std::optional<Sign> static_orient3d(const Point3& a, const Point3& b, const Point3& c,
                                    const Point3& d) {
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
    const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    const double dx = d.x - a.x, dy = d.y - a.y, dz = d.z - a.z;
    const double x = largest(bx, cx, dx), y = largest(by, cy, dy), z = largest(bz, cz, dz);
    if (x == 0 || y == 0 || z == 0) return Sign::Zero;
    if (!(std::min({x, y, z}) > low3 && std::max({x, y, z}) < high3)) return std::nullopt;
    const double value =
        (by * cz - bz * cy) * dx + (bz * cx - bx * cz) * dy + (bx * cy - by * cx) * dz;
    return beyond(value, 48 * unit * x * y * z);
}

struct Uv {
    double u, v;
};

Uv project(Axis axis, const Point3& p) {
    switch (axis) {
    case Axis::x:
        return {p.y, p.z};
    case Axis::y:
        return {p.z, p.x};
    default:
        return {p.x, p.y};
    }
}

// Two products of size U V, each off by 3 unit, and a subtraction: 8 unit U V; 9 covers the rest.
std::optional<Sign> static_turn2d(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    const double bu = b.u - a.u, bv = b.v - a.v, cu = d.u - c.u, cv = d.v - c.v;
    const double u = std::max(std::fabs(bu), std::fabs(cu));
    const double v = std::max(std::fabs(bv), std::fabs(cv));
    if (u == 0 || v == 0) return Sign::Zero;
    if (!(std::min(u, v) > low2 && std::max(u, v) < high2)) return std::nullopt;
    return beyond(bu * cv - bv * cu, 9 * unit * u * v);
}

// With m the largest difference: a minor is at most 2 m^2 and off by 8 unit m^2, a lifted
// coordinate at most 2 m^2 and off by 8 unit m^2 (two squares off by 3 each, a sum of size 2);
// their product at most 4 m^4, off by 36 unit m^4; three of them 108, two additions (8 + 12). 128
// in all; 132 covers the rest.
std::optional<Sign> static_in_circle(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    const double au = a.u - d.u, av = a.v - d.v, bu = b.u - d.u, bv = b.v - d.v;
    const double cu = c.u - d.u, cv = c.v - d.v;
    const double m = std::max(largest(au, bu, cu), largest(av, bv, cv));
    if (m == 0) return Sign::Zero;
    if (!(m > low4 && m < high4)) return std::nullopt;
    const double value = (au * au + av * av) * (bu * cv - bv * cu) +
                         (bu * bu + bv * bv) * (cu * av - cv * au) +
                         (cu * cu + cv * cv) * (au * bv - av * bu);
    return beyond(value, 132 * unit * (m * m) * (m * m));
}

// The axis along which the normal is longest, by more than rounding can hide: each of its
// coordinates is a minor of differences, off by at most 8 unit times the square of the largest.
std::optional<Axis> static_projection_axis(const Point3& a, const Point3& b, const Point3& c) {
    const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
    const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
    const double m = std::max(largest(bx, by, bz), largest(cx, cy, cz));
    if (!(m > low2 && m < high2)) return std::nullopt;
    const double x = std::fabs(by * cz - bz * cy), y = std::fabs(bz * cx - bx * cz),
                 z = std::fabs(bx * cy - by * cx);
    const double bound = 18 * unit * m * m;
    if (x > y + bound && x > z + bound) return Axis::x;
    if (y > z + bound && y > x + bound) return Axis::y;
    if (z > x + bound && z > y + bound) return Axis::z;
    return std::nullopt;
}

// Stages two and three. `polynomial` is generic over the number type.
template <class Polynomial>
Sign filtered(const Polynomial& polynomial) {
    {
        const UpwardRounding guard;
        if (const auto sign = certain_sign(polynomial(Interval{}))) {
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

// |n.x|, |n.y|, |n.z| compared: > 0 iff |first| > |second|.
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

Sign orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    if (const auto sign = static_orient3d(a, b, c, d)) {
        ++predicate_counts().static_filter;
        return *sign;
    }
    return filtered([&]<class N>(N) {
        return polynomial::orient3d(cartesian<N>(a), cartesian<N>(b), cartesian<N>(c),
                                    cartesian<N>(d));
    });
}

Sign turn2d(Axis axis, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
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

Sign in_circle(Axis axis, const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
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
