// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Filters with room, for points within a radius and for a distance between triangles: inputs for
// which that room just suffices, in all rounding modes. Rationals judge.
#include "support/filter_limits.hpp"

#include <terrane/kernel/separation_filter.hpp>

#include <catch2/catch.hpp>

namespace {

using namespace test_support;

/// Points within the radius of x, as far as they can push the polynomial towards a sign: each
/// coordinate moves by the radius, in the direction of the slope.
mpq_class pushed(const Filter& f, const Coordinates& x, double radius, int towards) {
    std::vector<mpq_class> at(x.begin(), x.end());
    std::vector<int> slopes;
    Coordinates y = x;
    for (double& c : y) {
        const double kept = c;
        c += 0x1p-20;
        const mpq_class up = f.exact(y);
        c = kept - 0x1p-20;
        slopes.push_back(sgn(mpq_class(up - f.exact(y))) * towards);
        c = kept;
    }
    // The radius is a power of two and the coordinates are multiples of 2^-52, so this is exact.
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += slopes[i] * radius;
    return f.exact(y);
}

/// The answer of a filter of points within a radius, and whether points within it can have another
/// sign.
template <class Signed>
void judge_balls(const Filter& f, int first_exponent, int last_exponent, std::uint64_t seed,
                 const Signed& sign_with_radius) {
    Random random(seed);
    int decided = 0, at_limit = 0;
    for (int i = 0; i < cases(6'000); ++i) {
        const double radius = std::ldexp(1, random_int(random, first_exponent, last_exponent));
        Coordinates x = nearly_zero(random, f);
        for (double& c : x) c = std::ldexp(std::round(std::ldexp(c, 40)), -40);
        if (random_int(random, 0, 2) != 0) { // to where the radii just decide
            const double share = random_real(random, 0.5, 30) * (i % 2 == 0 ? 1 : -1);
            Coordinates tuned = x;
            tune(f, tuned, mpq_class(share) * mpq_class(radius));
            for (double& c : tuned) c = std::ldexp(std::round(std::ldexp(c, 48)), -48);
            x = tuned;
        }
        std::optional<Sign> sign;
        {
            const Mode set(modes[static_cast<std::size_t>(i) % modes.size()]);
            sign = sign_with_radius(x, radius);
        }
        const int is = sgn(f.exact(x));
        const mpq_class against = pushed(f, x, radius, -is);
        at_limit += abs(against) < abs(f.exact(x)) / 2;
        if (!sign) continue;
        ++decided;
        REQUIRE(*sign == sign_of(f.exact(x)));
        REQUIRE(*sign == sign_of(against));
    }
    CHECK(decided > cases(500));
    CHECK(at_limit > cases(500));
}

} // namespace

TEST_CASE("filters with room: orient2d of balls holds for the worst points within the radii") {
    judge_balls(turn, -44, -6, 15, [](const Coordinates& x, double radius) {
        const auto ball = [&](unsigned k) {
            return ApproximatePoint{x[2 * k], x[2 * k + 1], radius};
        };
        return filtered_orient2d(ball(0), ball(1), ball(2));
    });
}

TEST_CASE("filters with room: in_circle of balls holds for the worst points within the radii") {
    judge_balls(circle, -44, -12, 16, [](const Coordinates& x, double radius) {
        const auto ball = [&](unsigned k) {
            return ApproximatePoint{x[2 * k], x[2 * k + 1], radius};
        };
        return filtered_in_circle(ball(0), ball(1), ball(2), ball(3));
    });
}

TEST_CASE("filters with room: the smallest radius keeps its room in any rounding mode") {
    // Each true coordinate may differ by 2^-1074, the least positive double.
    Random random(17);
    const double least = 0x1p-1074;
    for (int i = 0; i < cases(400); ++i) {
        Coordinates x = nearly_zero(random, circle);
        for (double& c : x) c = std::ldexp(c, random_int(random, 0, 1) == 0 ? 0 : 245);
        std::optional<Sign> sign;
        {
            const Mode set(modes[static_cast<std::size_t>(i) % modes.size()]);
            const auto ball = [&](unsigned k) {
                return ApproximatePoint{x[2 * k], x[2 * k + 1], least};
            };
            sign = filtered_in_circle(ball(0), ball(1), ball(2), ball(3));
        }
        if (sign) REQUIRE(*sign == sign_of(circle.exact(x)));
    }
}

namespace {

/// The square of the distance of a point from the plane of three.
mpq_class squared_distance(const Coordinates& x) {
    const auto d = [&](unsigned k, unsigned i) { return minus(x[3 * k + i], x[i]); };
    mpq_class length = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned j = (i + 1) % 3, k = (i + 2) % 3;
        const mpq_class n = d(1, j) * d(2, k) - d(1, k) * d(2, j);
        length += n * n;
    }
    const mpq_class det = side.exact(x);
    return det * det / length;
}

double largest_of(const Coordinates& x) {
    double most = 0;
    for (const double c : x) most = std::max(most, std::fabs(c));
    return most;
}

/// Whether a point is at least the distance of law (1) from the plane of a triangle.
bool has_room(const Coordinates& x) {
    const mpq_class m = largest_of({x.begin(), x.begin() + 9}),
                    n = largest_of({x.begin() + 9, x.end()});
    const mpq_class room = (m + n) * mpq_class(SeparationFilter::least_distance);
    return squared_distance(x) >= room * room;
}

bool is_beside(const Coordinates& x, int mode) {
    const Mode set(mode);
    const Point3 p = xyz(x, 3);
    return SeparationFilter(xyz(x, 0), xyz(x, 1), xyz(x, 2)).is_beside(p, p, p);
}

} // namespace

TEST_CASE("filters with room: what lies beside a plane keeps the distance of law 1") {
    Random random(18);
    int told = 0, near_limit = 0;
    for (int i = 0; i < cases(6'000); ++i) {
        Coordinates x = nearly_zero(random, side);
        const int thin =
            random_int(random, 0, 60); // triangles that are nearly lines in a projection
        for (unsigned k = 0; k < 3; ++k)
            x[6 + k] = x[k] + (x[3 + k] - x[k]) * 2 + std::ldexp(minus_one_to_one(random), -thin);
        const auto e = side.estimate(x);
        if (!e) continue;
        const Point3 n = static_filter::Plane(xyz(x, 0), xyz(x, 1), xyz(x, 2)).normal();
        const double length = std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
        const double share = random_real(random, 0.9, 1.2) * (i % 2 == 0 ? 1 : -1);
        const double room = SeparationFilter::share * 2 * largest_of(x);
        tune(side, x, mpq_class(share) * mpq_class(e->bound + length * room));
        const bool beside = is_beside(x, modes[static_cast<std::size_t>(i) % modes.size()]);
        told += beside;
        near_limit += std::fabs(share) < 1.01;
        if (beside) REQUIRE(has_room(x));
    }
    CHECK(told > cases(500));
    CHECK(near_limit > cases(500));
}

TEST_CASE("filters with room: a normal that rounding makes short does not hide a small distance") {
    // In the projection along x the triangle is almost a line, and along x everything is tiny.
    Random random(19);
    int shortened = 0;
    for (int i = 0; i < cases(20'000); ++i) {
        const double tiny = 0x1p-110, u = one_to_two(random), v = one_to_two(random);
        const Coordinates x{0,
                            0,
                            0,
                            tiny * minus_one_to_one(random),
                            u,
                            v,
                            tiny * minus_one_to_one(random),
                            u * 1.75,
                            v * 1.75,
                            tiny * 4,
                            minus_one_to_one(random),
                            minus_one_to_one(random)};
        const Point3 n = static_filter::Plane(xyz(x, 0), xyz(x, 1), xyz(x, 2)).normal();
        shortened += n.x == 0 && minus(x[4], 0) * minus(x[8], 0) != minus(x[5], 0) * minus(x[7], 0);
        for (const int mode : modes)
            if (is_beside(x, mode)) REQUIRE(has_room(x));
    }
    CHECK(shortened > 0);
}
