// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the laws of predicates.hpp by number, then compares every predicate with exact integers.
#include "support/effort.hpp"
#include "support/oracle.hpp"
#include "support/points.hpp"

#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using namespace terrane;
using namespace test_support;

__extension__ using Int128 = __int128;

constexpr std::array all_axes{Axis::z, Axis::x, Axis::y};

Point3 along(Axis axis, double u, double v, double height) {
    if (axis == Axis::x) return {height, u, v};
    if (axis == Axis::y) return {v, height, u};
    return {u, v, height};
}

/// Visits `count` sets of five points of each family.
template <class Visit>
void for_point_sets(std::uint64_t seed, int count, const Visit& visit) {
    Random random(seed);
    for (const Family family : all_families)
        for (int i = 0; i < cases(count); ++i) {
            auto p = points_of(random, family, 5);
            if (random_int(random, 0, 9) == 0) p[4] = nudged(random, p[3]);
            visit(p);
        }
}

} // namespace

TEST_CASE("predicates law 1: orient3d of the unit corner is Positive") {
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == Sign::Positive);
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}) == Sign::Negative);
    CHECK(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}) == Sign::Zero);
}

TEST_CASE("predicates law 2: an odd permutation flips the sign, an even one keeps it") {
    for_point_sets(2, 400, [](const std::vector<Point3>& p) {
        const Sign s = orient3d(p[0], p[1], p[2], p[3]);
        bool ok = orient3d(p[1], p[0], p[2], p[3]) == -s &&
                  orient3d(p[0], p[2], p[1], p[3]) == -s &&
                  orient3d(p[0], p[1], p[3], p[2]) == -s && orient3d(p[1], p[2], p[0], p[3]) == s &&
                  orient3d(p[1], p[0], p[3], p[2]) == s && orient3d(p[3], p[1], p[2], p[0]) == -s;
        for (const Axis axis : all_axes) {
            const Sign t = orient2d(axis, p[0], p[1], p[2]);
            ok = ok && orient2d(axis, p[1], p[2], p[0]) == t &&
                 orient2d(axis, p[2], p[0], p[1]) == t && orient2d(axis, p[1], p[0], p[2]) == -t &&
                 orient2d(axis, p[0], p[2], p[1]) == -t && orient2d(axis, p[2], p[1], p[0]) == -t;
        }
        REQUIRE(ok);
    });
}

TEST_CASE("predicates law 3: a repeated point gives Zero") {
    for_point_sets(3, 400, [](const std::vector<Point3>& p) {
        const Point3 &a = p[0], &b = p[1], &c = p[2];
        bool ok = true;
        for (const auto& q : {std::array{a, a, b, c},
                              {a, b, a, c},
                              {a, b, c, a},
                              {b, a, a, c},
                              {b, a, c, a},
                              {b, c, a, a}})
            ok = ok && orient3d(q[0], q[1], q[2], q[3]) == Sign::Zero;
        for (const Axis axis : all_axes)
            ok = ok && orient2d(axis, a, a, b) == Sign::Zero &&
                 orient2d(axis, a, b, a) == Sign::Zero && orient2d(axis, b, a, a) == Sign::Zero;
        REQUIRE(ok);
    });
}

TEST_CASE("predicates law 4: orient2d is the sign of the normal along the axis") {
    for (const Axis axis : all_axes) {
        const Point3 a = along(axis, 0, 0, 7), b = along(axis, 1, 0, -3), c = along(axis, 0, 1, 11);
        CHECK(orient2d(axis, a, b, c) == Sign::Positive);
        CHECK(orient2d(axis, a, c, b) == Sign::Negative);
        CHECK(orient2d(axis, a, b, along(axis, 2, 0, 5)) == Sign::Zero);
        CHECK(turn2d(axis, a, b, a, c) == Sign::Positive);
        CHECK(turn2d(axis, a, b, c, a) == Sign::Negative);
        CHECK(turn2d(axis, a, b, c, along(axis, 5, 1, 0)) == Sign::Zero);
    }
    CHECK(orient2d(Axis::x, {9, 0, 0}, {8, 1, 0}, {7, 0, 1}) == Sign::Positive);
    CHECK(orient2d(Axis::y, {0, 9, 0}, {0, 8, 1}, {1, 7, 0}) == Sign::Positive);
    CHECK(orient2d(Axis::z, {0, 0, 9}, {1, 0, 8}, {0, 1, 7}) == Sign::Positive);
}

TEST_CASE("predicates law 5: in_circle") {
    for (const Axis axis : all_axes) {
        const Point3 a = along(axis, 1, 0, 5), b = along(axis, 0, 1, 6), c = along(axis, -1, 0, 7);
        CHECK(in_circle(axis, a, b, c, along(axis, 0, 0, 9)) == Sign::Positive);
        CHECK(in_circle(axis, a, b, c, along(axis, 0, -1, 2)) == Sign::Zero);
        CHECK(in_circle(axis, a, b, c, along(axis, 0, -2, 2)) == Sign::Negative);
        CHECK(in_circle(axis, b, a, c, along(axis, 0, 0, 9)) == Sign::Negative);
    }
    for_point_sets(5, 400, [](const std::vector<Point3>& p) {
        bool ok = true;
        for (const Axis axis : all_axes) {
            const Sign s = in_circle(axis, p[0], p[1], p[2], p[3]);
            ok = ok && in_circle(axis, p[1], p[2], p[0], p[3]) == s &&
                 in_circle(axis, p[1], p[0], p[2], p[3]) == -s &&
                 in_circle(axis, p[2], p[1], p[0], p[3]) == -s &&
                 in_circle(axis, p[0], p[2], p[1], p[3]) == -s;
            for (const Point3& repeated : {p[0], p[1], p[2]})
                ok = ok && in_circle(axis, p[0], p[1], p[2], repeated) == Sign::Zero;
        }
        REQUIRE(ok);
    });
}

TEST_CASE("predicates law 6: collinear iff orient2d is Zero along all axes") {
    CHECK(collinear({0, 0, 0}, {1, 2, 3}, {-2, -4, -6}));
    CHECK(collinear({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
    CHECK_FALSE(collinear({0, 0, 0}, {1, 0, 0}, {2, 0, 5e-324}));
    CHECK_FALSE(collinear({0, 0, 0}, {0, 0, 1}, {0, 5e-324, 2}));
    for_point_sets(6, 400, [](const std::vector<Point3>& p) {
        bool zero = true;
        for (const Axis axis : all_axes)
            zero = zero && orient2d(axis, p[0], p[1], p[2]) == Sign::Zero;
        REQUIRE(collinear(p[0], p[1], p[2]) == zero);
    });
}

TEST_CASE("orient3d agrees with exact integers") {
    for_point_sets(11, 40'000, [](const std::vector<Point3>& p) {
        const auto q = oracle::points(p);
        if (orient3d(p[0], p[1], p[2], p[3]) != oracle::orient3d(q[0], q[1], q[2], q[3]))
            FAIL("orient3d of " << Catch::StringMaker<double>::convert(p[0].x));
    });
}

TEST_CASE("orient2d and turn2d agree with exact integers along each axis") {
    for_point_sets(12, 9'000, [](const std::vector<Point3>& p) {
        const auto q = oracle::points(p);
        bool ok = true;
        for (const Axis axis : all_axes)
            ok = ok &&
                 orient2d(axis, p[0], p[1], p[2]) == oracle::orient2d(axis, q[0], q[1], q[2]) &&
                 turn2d(axis, p[0], p[1], p[2], p[3]) ==
                     oracle::turn2d(axis, q[0], q[1], q[2], q[3]) &&
                 turn2d(axis, p[0], p[1], p[3], p[4]) ==
                     oracle::turn2d(axis, q[0], q[1], q[3], q[4]);
        REQUIRE(ok);
    });
}

TEST_CASE("in_circle agrees with exact integers along each axis") {
    for_point_sets(13, 9'000, [](const std::vector<Point3>& p) {
        const auto q = oracle::points(p);
        bool ok = true;
        for (const Axis axis : all_axes)
            ok = ok && in_circle(axis, p[0], p[1], p[2], p[3]) ==
                           oracle::in_circle(axis, q[0], q[1], q[2], q[3]);
        REQUIRE(ok);
    });
}

TEST_CASE("in_circle agrees with exact integers where circles are common") {
    // Points on circles about the origin, and their neighbours: 25 = 0 + 25 = 9 + 16.
    const std::array<std::array<int, 2>, 6> on_circle{
        {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-3, 4}, {-4, -3}}};
    Random random(14);
    for (int i = 0; i < cases(60'000); ++i) {
        const double size = std::ldexp(1, random_int(random, -240, 240));
        const double east = random_int(random, 0, 1) ? 5e5 : 0;
        std::vector<Point3> p;
        for (int k = 0; k < 4; ++k) {
            const auto& c = on_circle[static_cast<std::size_t>(random_int(random, 0, 5))];
            p.push_back(along(Axis::z, c[0] * size + east, c[1] * size, 0));
            if (random_int(random, 0, 3) == 0) p.back().x = nudged(random, p.back().x);
        }
        const auto q = oracle::points(p);
        REQUIRE(in_circle(Axis::z, p[0], p[1], p[2], p[3]) ==
                oracle::in_circle(Axis::z, q[0], q[1], q[2], q[3]));
    }
}

TEST_CASE("collinear and projection_axis agree with exact integers") {
    for_point_sets(15, 6'000, [](const std::vector<Point3>& p) {
        const auto q = oracle::points(p);
        const oracle::Row4 n = oracle::plane(q[0], q[1], q[2]);
        const bool flat = n[0] == 0 && n[1] == 0 && n[2] == 0;
        REQUIRE(collinear(p[0], p[1], p[2]) == flat);
        if (flat) return;
        const oracle::Int x = abs(n[0]), y = abs(n[1]), z = abs(n[2]);
        const Axis longest = z >= x && z >= y ? Axis::z : x >= y ? Axis::x : Axis::y;
        REQUIRE(projection_axis(p[0], p[1], p[2]) == longest);
    });
}

TEST_CASE("projection_axis: the first of z, x, y among equals, whatever the orientation") {
    CHECK(projection_axis({1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == Axis::z);
    CHECK(projection_axis({1, 0, 0}, {0, 0, 1}, {0, 1, 0}) == Axis::z);
    CHECK(projection_axis({0, 0, 0}, {0, 0, 1}, {1, -1, 0}) == Axis::x);
    CHECK(projection_axis({0, 0, 0}, {1, 0, 0}, {0, 0, 1}) == Axis::y);
}

TEST_CASE("nearly coplanar integers times a power of two, judged in 128 bits") {
    Random random(16);
    const auto integer = [](double d, int exponent) {
        return static_cast<Int128>(std::ldexp(d, -exponent));
    };
    for (int i = 0; i < cases(150'000); ++i) {
        const int exponent = random_int(random, -340, 340);
        const auto p = nearly_coplanar(random, 4, exponent);
        std::array<std::array<Int128, 3>, 3> d;
        for (unsigned k = 0; k < 3; ++k) {
            const Point3 &a = p[0], &b = p[k + 1];
            d[k] = {integer(b.x, exponent) - integer(a.x, exponent),
                    integer(b.y, exponent) - integer(a.y, exponent),
                    integer(b.z, exponent) - integer(a.z, exponent)};
        }
        const Int128 volume = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                              d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                              d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
        REQUIRE(orient3d(p[0], p[1], p[2], p[3]) == sign_of(volume));
    }
}

TEST_CASE("middles and parallelograms agree with exact integers, whether rounded or not") {
    Random random(19);
    int zeros = 0, others = 0;
    const auto combined = [](const Point3& p, const Point3& q, const auto& combine) {
        return Point3{combine(p.x, q.x), combine(p.y, q.y), combine(p.z, q.z)};
    };
    const int callers = std::fegetround();
    for (int i = 0; i < cases(20'000); ++i) {
        std::vector<Point3> p;
        for (int k = 0; k < 3; ++k)
            p.push_back(point_of([&] { return random_real(random, 1, 2); }));
        if (i % 2 == 0) {
            p.push_back(combined(p[0], p[1], [](double x, double y) { return (x + y) / 2; }));
        } else {
            p[1] = combined(p[0], p[1], [](double x, double y) { return x + (y - 1) * 0x1p-20; });
            const Point3 edge = combined(p[1], p[0], std::minus<>());
            p.push_back(combined(p[2], edge, std::plus<>()));
        }
        if (i % 5 == 0) p[3].x = std::nextafter(p[3].x, 0);
        std::shuffle(p.begin(), p.end(), random);
        const auto q = oracle::points(p);
        std::fesetround(std::array{FE_UPWARD, FE_TONEAREST, FE_DOWNWARD, FE_TOWARDZERO}[i % 4]);
        const Sign volume = orient3d(p[0], p[1], p[2], p[3]);
        std::array<Sign, 3> turns{};
        for (const Axis axis : all_axes)
            turns[static_cast<unsigned>(axis)] = turn2d(axis, p[0], p[1], p[2], p[3]);
        const Sign seen_from_z = orient2d(Axis::z, p[0], p[1], p[2]);
        std::fesetround(callers);
        REQUIRE(volume == oracle::orient3d(q[0], q[1], q[2], q[3]));
        REQUIRE(seen_from_z == oracle::orient2d(Axis::z, q[0], q[1], q[2]));
        for (const Axis axis : all_axes)
            REQUIRE(turns[static_cast<unsigned>(axis)] ==
                    oracle::turn2d(axis, q[0], q[1], q[2], q[3]));
        ++(volume == Sign::Zero ? zeros : others);
    }
    CHECK(zeros > cases(20'000) / 50);
    CHECK(others > cases(20'000) / 2);
}

TEST_CASE("the static filter decides random points, the others are reached by degenerate ones") {
    const int count = 2000;
    const auto count_stages = [](Family family) {
        Random random(17);
        const PredicateCounts before = predicate_counts();
        for (int i = 0; i < count; ++i) {
            const auto p = points_of(random, family, 4);
            orient3d(p[0], p[1], p[2], p[3]);
            orient2d(Axis::x, p[0], p[1], p[2]);
            in_circle(Axis::y, p[0], p[1], p[2], p[3]);
        }
        const PredicateCounts c = predicate_counts() - before;
        CHECK(c.static_filter + c.interval + c.exact == 3 * count);
        return c;
    };
    CHECK(count_stages(Family::uniform).static_filter > 3 * count * 0.999);
    CHECK(count_stages(Family::lattice).interval > count / 4);
    CHECK(count_stages(Family::decimals).exact > count / 100);
    CHECK(count_stages(Family::one_ulp).interval + count_stages(Family::one_ulp).exact > count / 2);
    CHECK(count_stages(Family::denormal).exact + count_stages(Family::denormal).interval > count);
}

TEST_CASE("each stage decides what is made for it") {
    const auto stage = [](const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
        const PredicateCounts before = predicate_counts();
        orient3d(a, b, c, d);
        const PredicateCounts n = predicate_counts() - before;
        return n.static_filter ? 's' : n.interval ? 'i' : n.exact ? 'e' : '?';
    };
    CHECK(stage({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}) == 's');
    CHECK(stage({0, 0, 0}, {1, 2, 3}, {2, 4, 7}, {3, 6, 10}) == 'i'); // small integers: exact zero
    CHECK(stage({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-300}) == 'i'); // below the static range
    CHECK(stage({0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.3, 0.6, 0.1}, {0.7, 1.4, 0.9}) == 'e');
    // One double away from that plane: intervals can't tell, numbers of 106 bits can.
    CHECK(stage({0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.3, 0.6, 0.1},
                {0.7, std::nextafter(1.4, 2.0), 0.9}) == 'i');
}

TEST_CASE("predicates do not depend on the rounding mode, and keep it") {
    const int callers = std::fegetround();
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST})
        for_point_sets(18, 250, [&](const std::vector<Point3>& p) {
            const auto q = oracle::points(p);
            std::fesetround(mode);
            const Sign volume = orient3d(p[0], p[1], p[2], p[3]);
            bool kept = std::fegetround() == mode;
            bool ok = volume == oracle::orient3d(q[0], q[1], q[2], q[3]);
            for (const Axis axis : all_axes) {
                const Sign turn_sign = orient2d(axis, p[0], p[1], p[2]);
                const Sign circle_sign = in_circle(axis, p[0], p[1], p[2], p[3]);
                ok = ok && turn_sign == oracle::orient2d(axis, q[0], q[1], q[2]) &&
                     circle_sign == oracle::in_circle(axis, q[0], q[1], q[2], q[3]);
            }
            kept = kept && std::fegetround() == mode;
            std::fesetround(callers);
            REQUIRE(ok);
            REQUIRE(kept);
        });
}
