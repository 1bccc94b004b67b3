// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/allowance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::tetrahedra {
namespace {

using polynomial::cartesian;

/// Whether a polynomial, generic over the number type, is >= 0.
template <class Polynomial>
bool not_negative(const Polynomial& value) {
    {
        const UpwardRounding guard;
        if (const auto sign = certain_sign(guard, value(Interval{})))
            return *sign != Sign::Negative;
    }
    return exact_sign(value(Exact{})) != Sign::Negative;
}

double largest(double a, double b, double c) {
    return std::max({std::fabs(a), std::fabs(b), std::fabs(c)});
}

double factor(Sign sign) {
    return static_cast<double>(static_cast<int>(sign));
}

using Coordinate = double Point3::*;
constexpr std::array<Coordinate, 3> coordinates{&Point3::x, &Point3::y, &Point3::z};

/// Whether p is between a and b in one coordinate, or no farther than e from there.
bool between(double p, double a, double b, double e) {
    const double low = std::min(a, b), high = std::max(a, b);
    return not_negative([&]<class N>(N) { return N(p) - N(low) + N(e); }) &&
           not_negative([&]<class N>(N) { return N(high) - N(p) + N(e); });
}

/// Whether a parameter t exists at which a + t (b - a) is near p in two coordinates, without regard
/// to the ends of the edge.
bool near_line(const Point3& p, const Point3& a, const Point3& b, Coordinate u, Coordinate v) {
    const Point3 e = allowance(a, b);
    const double along_u = factor(sign_of(b.*u - a.*u)), along_v = factor(sign_of(b.*v - a.*v));
    const auto slack = [&]<class N>(double side) {
        const N du = N(b.*u) - N(a.*u), dv = N(b.*v) - N(a.*v);
        const N turn = (N(p.*u) - N(a.*u)) * dv - (N(p.*v) - N(a.*v)) * du;
        return N(e.*u) * N(along_v) * dv + N(e.*v) * N(along_u) * du + N(side) * turn;
    };
    return not_negative([&]<class N>(N) { return slack.template operator()<N>(1); }) &&
           not_negative([&]<class N>(N) { return slack.template operator()<N>(-1); });
}

} // namespace

double spacing_at(double x) {
    const double size = std::fabs(x);
    constexpr double least = std::numeric_limits<double>::denorm_min();
    if (size < std::numeric_limits<double>::min()) return least;
    return std::max(std::ldexp(1.0, std::ilogb(size) - 52), least);
}

Point3 allowance(const std::array<Point3, 3>& t) {
    const auto of = [&](Coordinate c) {
        return allowed_spacings * spacing_at(largest(t[0].*c, t[1].*c, t[2].*c));
    };
    return {of(&Point3::x), of(&Point3::y), of(&Point3::z)};
}

Point3 allowance(const Point3& a, const Point3& b) {
    return allowance({a, b, b});
}

// The parameters at which a + t (b - a) is near p in one coordinate are an interval, and so is
// [0, 1]. Intervals have a common point iff every two of them have one.
bool near_edge(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 e = allowance(a, b);
    for (const Coordinate c : coordinates)
        if (!between(p.*c, a.*c, b.*c, e.*c)) return false;
    return near_line(p, a, b, &Point3::x, &Point3::y) &&
           near_line(p, a, b, &Point3::y, &Point3::z) && near_line(p, a, b, &Point3::z, &Point3::x);
}

// A vector within the box of half sizes e has a product of |n.x| e.x + |n.y| e.y + |n.z| e.z with n
// at most, and every smaller product occurs.
bool near_plane(const Point3& p, const std::array<Point3, 3>& t) {
    const Point3 e = allowance(t);
    const Point3 towards{factor(orient2d(Axis::x, t[0], t[1], t[2])),
                         factor(orient2d(Axis::y, t[0], t[1], t[2])),
                         factor(orient2d(Axis::z, t[0], t[1], t[2]))};
    const auto slack = [&]<class N>(double side) {
        const auto a = cartesian<N>(t[0]);
        const auto n = cross(difference(cartesian<N>(t[1]), a), difference(cartesian<N>(t[2]), a));
        return n.x * N(towards.x) * N(e.x) + n.y * N(towards.y) * N(e.y) +
               n.z * N(towards.z) * N(e.z) + N(side) * dot(n, difference(cartesian<N>(p), a));
    };
    return not_negative([&]<class N>(N) { return slack.template operator()<N>(1); }) &&
           not_negative([&]<class N>(N) { return slack.template operator()<N>(-1); });
}

double reach(const std::array<Point3, 3>& triangle) {
    const Point3 e = allowance(triangle);
    // Along the axis of projection: e of that coordinate and twice the sum of the others. Which
    // axis that is does not matter if each gets all.
    const double sum = e.x + e.y + e.z;
    return std::sqrt(e.x * e.x + e.y * e.y + e.z * e.z + 4 * sum * sum) * (1 + rounding_room);
}

double volume_within_reach(const std::array<Point3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const Point3 ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    const double d = reach(triangle), area = length(ab) * length(ac) / 2; // at least the area
    const double perimeter = length(ab) + length(ac) + length(bc);
    const double pi = std::numbers::pi;
    return (2 * d * area + pi / 2 * d * d * perimeter + pi * 4 / 3 * d * d * d) *
           (1 + rounding_room);
}

} // namespace terrane::tetrahedra
