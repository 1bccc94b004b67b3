// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/kernel/ball_filter.hpp>
#include <terrane/kernel/plane_filter.hpp>
#include <terrane/kernel/predicates.hpp>
#include <terrane/kernel/separation_filter.hpp>

#include <catch2/catch.hpp>

#include <cfenv>

namespace {

using namespace terrane;
using namespace test_support;

ApproximatePoint flat(const Point3& p, double radius = 0) {
    return {p.x, p.y, radius};
}

/// Returns a random point within the radius of p.
Point3 within(Random& random, const Point3& p, double radius) {
    const auto off = [&](double d) {
        const double moved = d + random_int(random, -4, 4) * radius / 4;
        return std::fabs(moved - d) <= radius ? moved : d;
    };
    return {off(p.x), off(p.y), p.z};
}

using Corners = std::array<Point3, 3>;

/// Tells exactly whether two triangles are apart; true if one of them has no area.
bool are_apart(const Corners& t, const Corners& u) {
    if (collinear(t[0], t[1], t[2]) || collinear(u[0], u[1], u[2])) return true;
    const std::array points{t[0], t[1], t[2], u[0], u[1], u[2]};
    return !improper_contact(points, {0, 1, 2}, {3, 4, 5});
}

double largest_of(const Corners& t) {
    double most = 0;
    for (const Point3& p : t)
        most = std::max({most, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return most;
}

/// Moves each coordinate by up to twice the rounding error of the largest one.
Corners shaken(Random& random, const Corners& t) {
    const double by = largest_of(t) * 0x1p-52;
    const auto off = [&](double d) { return d + random_int(random, -1, 1) * by; };
    Corners moved = t;
    for (Point3& p : moved) p = {off(p.x), off(p.y), off(p.z)};
    return moved;
}

} // namespace

TEST_CASE("approximate law 2: with radius 0 the filters agree with the predicates") {
    Random random(1);
    int decided = 0;
    for (const Family family : all_families)
        for (int i = 0; i < cases(20'000); ++i) {
            const auto p = points_of(random, family, 4);
            if (const auto s = filtered_orient2d(flat(p[0]), flat(p[1]), flat(p[2]))) {
                ++decided;
                REQUIRE(*s == orient2d(Axis::z, p[0], p[1], p[2]));
            }
            if (const auto s = filtered_in_circle(flat(p[0]), flat(p[1]), flat(p[2]), flat(p[3]))) {
                ++decided;
                REQUIRE(*s == in_circle(Axis::z, p[0], p[1], p[2], p[3]));
            }
        }
    CHECK(decided > cases(100'000));
}

TEST_CASE("approximate law 1: a sign holds for all points within the radii") {
    Random random(2);
    int decided = 0;
    for (int i = 0; i < cases(100'000); ++i) {
        const auto p = points_of(random, i % 2 == 0 ? Family::uniform : Family::utm, 4);
        const double radius = std::ldexp(1.0, random_int(random, -40, 2));
        const auto a = [&](int k) { return flat(p[static_cast<std::size_t>(k)], radius); };
        const auto turn = filtered_orient2d(a(0), a(1), a(2));
        const auto circle = filtered_in_circle(a(0), a(1), a(2), a(3));
        decided += turn.has_value() + circle.has_value();
        for (int tries = 0; tries < 4; ++tries) {
            std::array<Point3, 4> q;
            for (std::size_t k = 0; k < 4; ++k) q[k] = within(random, p[k], radius);
            if (turn) REQUIRE(*turn == orient2d(Axis::z, q[0], q[1], q[2]));
            if (circle) REQUIRE(*circle == in_circle(Axis::z, q[0], q[1], q[2], q[3]));
        }
    }
    CHECK(decided > cases(10'000));
}

TEST_CASE("quick plane law 1: a side is the sign of orient3d, in any rounding mode") {
    Random random(3);
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        int decided = 0;
        for (const Family family : all_families)
            for (int i = 0; i < cases(5'000); ++i) {
                const auto p = points_of(random, family, 4);
                std::fesetround(mode);
                const auto side = PlaneFilter(p[0], p[1], p[2]).side(p[3]);
                std::fesetround(FE_TONEAREST);
                if (!side) continue;
                ++decided;
                REQUIRE(*side == orient3d(p[0], p[1], p[2], p[3]));
            }
        CHECK(decided > cases(10'000));
    }
}

TEST_CASE("quick triangle law 1: what it tells apart is so after rounding, in any rounding mode") {
    Random random(4);
    for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        int beside = 0, beyond = 0;
        for (const Family family : all_families)
            for (int i = 0; i < cases(5'000); ++i) {
                const auto p = points_of(random, family, 6);
                const Corners t{p[0], p[1], p[2]}, u{p[3], p[4], p[5]};
                std::fesetround(mode);
                const SeparationFilter quick(t[0], t[1], t[2]);
                const bool is_beside = quick.is_beside(u[0], u[1], u[2]);
                const bool is_beyond = quick.is_beyond(u[0], u[1], u[2]);
                std::fesetround(FE_TONEAREST);
                beside += is_beside;
                beyond += is_beyond;
                if (!is_beside && !is_beyond) continue;
                for (int tries = 0; tries < 4; ++tries)
                    REQUIRE(are_apart(shaken(random, t), shaken(random, u)));
            }
        CHECK(beside > cases(5'000));
        CHECK(beyond > cases(1'000));
    }
}
