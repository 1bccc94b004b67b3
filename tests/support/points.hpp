// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Random points, easy and hard, by family.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <terrane/kernel/point.hpp>

namespace test_support {

using terrane::Point3;
using Random = std::mt19937_64;

enum class Family {
    uniform,       ///< in the unit cube
    lattice,       ///< integers from -2 to 2: degenerate more often than not
    decimals,      ///< multiples of 0.1, not exact in binary: nearly degenerate
    one_ulp,       ///< on one plane as far as doubles go, each coordinate off by an ulp at most
    utm,           ///< metres in centimetre steps at easting 5e5, northing 4.2e6
    tiny,          ///< about 1e-300
    denormal,      ///< few units of the smallest denormal
    around_normal, ///< lattice at the smallest normal numbers
    huge,          ///< about 1e300
    largest,       ///< up to the largest double
    float_range,   ///< about 3.4e38
    mixed,         ///< each coordinate of any exponent
    mixed_axes,    ///< each axis of its own scale
    edge_of_range, ///< as one_ulp, so small or large that products under- or overflow
    coplanar,      ///< nearly coplanar integers times a power of two
};

inline constexpr std::array all_families{
    Family::uniform,    Family::lattice,       Family::decimals,    Family::one_ulp,
    Family::utm,        Family::tiny,          Family::denormal,    Family::around_normal,
    Family::huge,       Family::largest,       Family::float_range, Family::mixed,
    Family::mixed_axes, Family::edge_of_range, Family::coplanar};

inline int random_int(Random& random, int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
}

inline double random_real(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// Returns n points in a cube around `middle` whose edges are 2 * scale long.
inline std::vector<Point3> random_points(std::size_t n, unsigned seed, double scale = 1,
                                         const Point3& middle = {}) {
    Random random(seed);
    std::uniform_real_distribution<double> x(-scale, scale);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < n; ++i) {
        Point3 p = middle;
        for (double* c : {&p.x, &p.y, &p.z}) *c += x(random);
        points.push_back(p);
    }
    return points;
}

/// Changes a number by one ulp, down or up, or not at all; the result is finite.
inline double nudged(Random& random, double d) {
    const int step = random_int(random, -1, 1);
    const double next = std::nextafter(d, step * HUGE_VAL);
    return step == 0 || std::isinf(next) ? d : next;
}

inline Point3 nudged(Random& random, const Point3& p) {
    return {nudged(random, p.x), nudged(random, p.y), nudged(random, p.z)};
}

inline double any_double(Random& random) {
    const double mantissa = random_int(random, 0, 9) == 0 ? 0 : random_real(random, -1, 1);
    return std::ldexp(mantissa, random_int(random, -1073, 1023));
}

/// Returns a point whose coordinates are results of make().
template <class Make>
Point3 point_of(const Make& make) {
    const double x = make(), y = make(), z = make();
    return {x, y, z};
}

/// Returns points with integers below 2^20 in size near a plane through the origin, times
/// 2^exponent.
inline std::vector<Point3> nearly_coplanar(Random& random, std::size_t count, int exponent) {
    const auto coordinate = [&] { return double(random_int(random, -511, 511)); };
    const Point3 u = point_of(coordinate), v = point_of(coordinate);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const int s = random_int(random, -500, 500), t = random_int(random, -500, 500);
        const auto at = [&](double a, double b) {
            const int off = random_int(random, 0, 5) == 0 ? random_int(random, -1, 1) : 0;
            return std::ldexp(s * a + t * b + off, exponent);
        };
        points.push_back({at(u.x, v.x), at(u.y, v.y), at(u.z, v.z)});
    }
    return points;
}

/// Returns points on a plane, as nearly as doubles allow.
inline std::vector<Point3> one_ulp_points(Random& random, std::size_t count) {
    const auto real = [&] { return random_real(random, -1, 1); };
    const Point3 a = point_of(real), u = point_of(real), v = point_of(real);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double s = random_int(random, -3, 3) / 4.0, t = random_int(random, -3, 3) / 3.0;
        points.push_back(nudged(random, Point3{a.x + s * u.x + t * v.x, a.y + s * u.y + t * v.y,
                                               a.z + s * u.z + t * v.z}));
    }
    return points;
}

/// Returns points for which products of two, three or four differences are about the smallest or
/// largest doubles.
inline std::vector<Point3> edge_of_range_points(Random& random, std::size_t count) {
    const int degree = random_int(random, 2, 4);
    const int exponent = random_int(random, 0, 1) ? 1020 / degree + random_int(random, -3, 6)
                                                  : -1075 / degree + random_int(random, -3, 20);
    auto points = one_ulp_points(random, count);
    for (Point3& p : points)
        p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    return points;
}

inline double lattice_number(Random& random) {
    return random_int(random, -2, 2);
}

/// Returns a point of a family whose points are independent of each other.
inline Point3 single_point(Random& random, Family family) {
    const auto integer = [&] { return lattice_number(random); };
    const auto real = [&](double size) {
        return point_of([&] { return random_real(random, -size, size); });
    };
    const auto times = [&](double size) { return point_of([&] { return integer() * size; }); };
    switch (family) {
    case Family::lattice:
        return times(1);
    case Family::decimals:
        return point_of([&] { return random_int(random, -9, 9) * 0.1; });
    case Family::utm: {
        const auto metres = [&] { return random_int(random, -300, 300) * 0.01; };
        const double x = metres(), y = metres(), z = metres();
        return {5e5 + x, 4.2e6 + y, z};
    }
    case Family::tiny:
        return random_int(random, 0, 1) ? real(1e-300) : times(1e-300);
    case Family::denormal:
        return times(std::numeric_limits<double>::denorm_min());
    case Family::around_normal:
        return times(std::numeric_limits<double>::min());
    case Family::huge:
        return random_int(random, 0, 1) ? real(1e300) : times(1e300);
    case Family::largest:
        return times(std::numeric_limits<double>::max() / 2);
    case Family::float_range:
        return random_int(random, 0, 1) ? real(3.4e38) : times(3.4e38);
    case Family::mixed:
        return point_of([&] { return any_double(random); });
    default:
        return real(1);
    }
}

inline std::vector<Point3> points_of(Random& random, Family family, std::size_t count) {
    if (family == Family::coplanar)
        return nearly_coplanar(random, count, random_int(random, -300, 300));
    if (family == Family::one_ulp) return one_ulp_points(random, count);
    if (family == Family::edge_of_range) return edge_of_range_points(random, count);
    std::vector<Point3> points;
    if (family == Family::mixed_axes) {
        const int ex = random_int(random, -1000, 1000), ey = random_int(random, -1000, 1000),
                  ez = random_int(random, -1000, 1000);
        for (std::size_t i = 0; i < count; ++i)
            points.push_back({std::ldexp(lattice_number(random), ex),
                              std::ldexp(lattice_number(random), ey),
                              std::ldexp(lattice_number(random), ez)});
        return points;
    }
    for (std::size_t i = 0; i < count; ++i) points.push_back(single_point(random, family));
    return points;
}

template <class F>
std::vector<double> values_at(const std::vector<Point3>& points, const F& f) {
    std::vector<double> values;
    for (const Point3& p : points) values.push_back(f(p));
    return values;
}

inline std::vector<Point3> scattered(Random& random, int count, double size) {
    std::vector<Point3> points;
    for (int i = 0; i < count; ++i)
        points.push_back({random_real(random, 0, size), random_real(random, 0, size), 0});
    return points;
}

} // namespace test_support
