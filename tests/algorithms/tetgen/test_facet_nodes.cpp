// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Nodes that a mesher put off a triangle, judged in rational numbers.
#include <terrane/algorithms/tetgen/detail/facet_nodes.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <catch2/catch.hpp>
#include <gmpxx.h>

#include "support/effort.hpp"

using namespace terrane;
using namespace terrane::tetgen::detail;

namespace {

using Rational = mpq_class;
using Rational3 = std::array<Rational, 3>;

Rational3 rational(const Point3& p) {
    return {Rational(p.x), Rational(p.y), Rational(p.z)};
}
Rational3 minus(const Rational3& a, const Rational3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational3 cross(const Rational3& a, const Rational3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational dot(const Rational3& a, const Rational3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double spacing(double x) {
    return std::ldexp(1.0, std::ilogb(std::fabs(x)) - 52);
}

/// Tells whether p are the doubles nearest to the foot: off by half a spacing at most.
bool is_rounded(const Point3& p, const Rational3& foot) {
    const Rational3 off = minus(rational(p), foot);
    return abs(off[0]) <= Rational(spacing(p.x)) / 2 && abs(off[1]) <= Rational(spacing(p.y)) / 2 &&
           abs(off[2]) <= Rational(spacing(p.z)) / 2;
}

/// One triangle, 0 1 2, in a box, divided by node 11 in it, 12 on the edge 0 1 and 13 on 1 2.
struct Divided {
    TetgenDomain domain;
    TetgenOutput output;

    explicit Divided(const std::array<Point3, 3>& corners) {
        domain.points.assign(corners.begin(), corners.end());
        domain.points.resize(11); // the corners of the box are not looked at
        domain.triangles = {{0, 1, 2}};
        output.points = domain.points;
        output.points.push_back(at(0.3, 0.4));
        output.points.push_back(at(0.4, 0));
        output.points.push_back(at(0.7, 0.3));
        output.faces = {{0, 12, 11}, {12, 1, 11}, {1, 13, 11}, {11, 13, 2}, {2, 0, 11}};
        output.face_facet.assign(output.faces.size(), 0);
    }
    [[nodiscard]] Point3 at(double s, double t) const {
        const auto& [a, b, c] = std::array{domain.points[0], domain.points[1], domain.points[2]};
        return {a.x + s * (b.x - a.x) + t * (c.x - a.x), a.y + s * (b.y - a.y) + t * (c.y - a.y),
                a.z + s * (b.z - a.z) + t * (c.z - a.z)};
    }
    [[nodiscard]] Rational3 foot_on_plane(const Point3& p) const {
        const auto a = rational(domain.points[0]);
        const auto n =
            cross(minus(rational(domain.points[1]), a), minus(rational(domain.points[2]), a));
        const auto q = rational(p);
        const Rational share = dot(n, minus(q, a)) / dot(n, n);
        return {q[0] - share * n[0], q[1] - share * n[1], q[2] - share * n[2]};
    }
    [[nodiscard]] Rational3 foot_on_edge(const Point3& p, unsigned i, unsigned j) const {
        const auto a = rational(domain.points[i]);
        const auto d = minus(rational(domain.points[j]), a);
        const Rational share = dot(d, minus(rational(p), a)) / dot(d, d);
        return {a[0] + share * d[0], a[1] + share * d[1], a[2] + share * d[2]};
    }
};

} // namespace

TEST_CASE("facet nodes: one that is farther off than allowed goes to the nearest doubles",
          "[tetrahedra]") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> number(-4, 4);
    for (unsigned i = 0; i < unsigned(test_support::cases(200)); ++i) {
        const double far = i % 2 == 0 ? 0 : 431000.1; // coordinates of a survey
        std::array<Point3, 3> corners{};
        for (Point3& p : corners)
            p = {far + number(random), 8 * far + number(random), number(random)};
        Divided made(corners);
        for (std::size_t v = 11; v < 14; ++v) {
            Point3& p = made.output.points[v];
            const double off = 40 * spacing(8 * far + 4);
            p = {p.x + off * number(random), p.y + off * number(random),
                 p.z + off * number(random)};
        }
        const auto before = made.output.points;
        CHECK(put_on_triangles(made.domain, made.output));
        const auto after = made.output.points;
        std::size_t moved = 0;
        for (std::size_t v = 11; v < 14; ++v) moved += after[v] == before[v] ? 0 : 1;
        CHECK(std::equal(after.begin(), after.begin() + 11, before.begin()));
        if (!(after[11] == before[11]))
            CHECK(is_rounded(after[11], made.foot_on_plane(before[11])));
        if (!(after[12] == before[12]))
            CHECK(is_rounded(after[12], made.foot_on_edge(before[12], 0, 1)));
        if (!(after[13] == before[13]))
            CHECK(is_rounded(after[13], made.foot_on_edge(before[13], 1, 2)));
        CHECK(moved > 0);
        CHECK(put_on_triangles(made.domain, made.output));
        CHECK(made.output.points == after);
    }
}

TEST_CASE("facet nodes: one that is near enough stays, bit by bit", "[tetrahedra]") {
    Divided made({Point3{1, 0.1, 0.3}, Point3{5, 0.7, 0.2}, Point3{1.5, 6, 0.9}});
    const auto before = made.output.points;
    CHECK(put_on_triangles(made.domain, made.output));
    CHECK(made.output.points == before);
}

TEST_CASE("facet nodes: what rounding cannot explain is refused, and nothing moves",
          "[tetrahedra]") {
    const Divided sound({Point3{0, 0, 0}, Point3{4, 0, 1}, Point3{0, 4, 2}});
    const auto is_refused = [](Divided made) {
        const auto before = made.output.points;
        return !put_on_triangles(made.domain, made.output) && made.output.points == before;
    };
    CHECK_FALSE(is_refused(sound));
    for (std::size_t v = 11; v < 14; ++v) {
        Divided far = sound; // off by a hundred millionth
        far.output.points[v].z += 0x1p-26;
        CHECK(is_refused(far));
    }
    Divided beyond = sound; // on the line of its edge, but not between its ends
    beyond.output.points[12] = sound.at(-0.25, 0);
    CHECK(is_refused(beyond));
    Divided open = sound; // node 11 is then on the border, and on no edge
    open.output.faces.pop_back();
    open.output.face_facet.pop_back();
    CHECK(is_refused(open));
    Divided apart = sound;
    apart.output.faces = {sound.output.faces[0], sound.output.faces[3]};
    apart.output.face_facet.resize(2);
    CHECK(is_refused(apart));
    Divided of_the_box = sound; // facet 1 is a side of the box
    of_the_box.output.points[11].z += 0x1p-26;
    of_the_box.output.face_facet.assign(5, 1);
    CHECK_FALSE(is_refused(of_the_box));
}
