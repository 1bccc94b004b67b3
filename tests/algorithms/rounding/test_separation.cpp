// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Moves the parts by far more than rounding would, so that some of them do meet. Each pair that is
// not listed as unproven must meet properly.
#include "support/effort.hpp"
#include "support/points.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/intersection/intersection.hpp>
#include <terrane/algorithms/rounding/detail/separation.hpp>
#include <terrane/kernel/predicates.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

enum class Shape {
    planes,     ///< large triangles that cross each other
    lattice,    ///< small integers: coplanar, touching, in line
    shallow,    ///< crossing at small angles
    of_a_sheet, ///< neighbours, crossed by one large triangle
};

constexpr std::array all_shapes{Shape::planes, Shape::lattice, Shape::shallow, Shape::of_a_sheet};

Surface loose(Random& random, Shape shape) {
    Surface s;
    const int count = random_int(random, 2, 6);
    for (int i = 0; i < 3 * count; ++i) {
        const auto integer = [&] { return double(random_int(random, 0, 3)); };
        const auto real = [&] { return random_real(random, 0, 1); };
        Point3 p = shape == Shape::lattice ? point_of(integer) : point_of(real);
        if (shape == Shape::shallow) p.z *= 1e-4;
        s.vertices.push_back(p);
    }
    for (std::uint32_t t = 0; t < static_cast<std::uint32_t>(count); ++t)
        s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    return s;
}

Surface crossed_sheet(Random& random) {
    Surface s;
    for (int v = 0; v < 3; ++v)
        for (int u = 0; u < 3; ++u)
            s.vertices.push_back({u + 0.0, v + 0.0, random_real(random, 0, 0.1)});
    for (std::uint32_t v = 0; v < 2; ++v)
        for (std::uint32_t u = 0; u < 2; ++u) {
            const std::uint32_t a = 3 * v + u;
            s.triangles.push_back({a, a + 1, a + 3});
            s.triangles.push_back({a + 1, a + 4, a + 3});
        }
    for (int i = 0; i < 3; ++i)
        s.vertices.push_back(point_of([&] { return random_real(random, -2, 4); }));
    s.triangles.push_back({9, 10, 11});
    return s;
}

struct Moved {
    std::vector<Point3> points;
    std::vector<double> moves;
};

/// Moves each vertex of the arrangement by at most `size`.
Moved moved(Random& random, const Arrangement& a, double size) {
    Moved m;
    for (const PointIndex v : a.vertices) {
        const Point3 p = a.state->points.nearest(v);
        const double most = size / 2;
        const Point3 by = point_of([&] { return random_real(random, -most, most); });
        m.points.push_back({p.x + by.x, p.y + by.y, p.z + by.z});
        m.moves.push_back(size);
    }
    return m;
}

std::vector<CandidatePair> all_pairs(std::uint32_t count) {
    std::vector<CandidatePair> pairs;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = i + 1; j < count; ++j) pairs.push_back({i, j});
    return pairs;
}

bool has_flat(const Moved& m, const std::vector<Triangle>& triangles) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
        return collinear(m.points[t[0]], m.points[t[1]], m.points[t[2]]);
    });
}

struct Found {
    int improper = 0, missed = 0, clear = 0;
};

Point3 between(const Point3& a, const Point3& b, double at) {
    return {a.x + at * (b.x - a.x), a.y + at * (b.y - a.y), a.z + at * (b.z - a.z)};
}

/// Tells whether find_unproven lists the pair. Parts in ill_conditioned count only for pairs within
/// a face.
bool is_listed(const Arrangement& a, const Unproven& unproven, const CandidatePair& p) {
    const auto has = [](const auto& list, const auto& value) {
        return std::binary_search(list.begin(), list.end(), value);
    };
    if (std::find(unproven.pairs.begin(), unproven.pairs.end(), p) != unproven.pairs.end() ||
        has(unproven.parts, p.first) || has(unproven.parts, p.second))
        return true;
    const auto faces = a.parents_of[p.first], others = a.parents_of[p.second];
    const bool within_a_face = std::any_of(faces.begin(), faces.end(), [&](std::uint32_t f) {
        return std::find(others.begin(), others.end(), f) != others.end();
    });
    return within_a_face &&
           (has(unproven.ill_conditioned, p.first) || has(unproven.ill_conditioned, p.second));
}

void examine(Random& random, const Surface& surface, double size, Found& found) {
    const Arrangement a = arrange(std::vector{surface}).value();
    if (!a.degenerate.empty() || !a.inputs.duplicates.empty() || a.triangles.size() > 400) return;
    const Moved m = moved(random, a, size);
    if (has_flat(m, a.triangles)) return;
    const Unproven unproven = find_unproven({a.state->points.inputs(), a.state->corners, a.vertices,
                                             m.points, m.moves, a.triangles, a.parents_of},
                                            all_pairs(a.inputs.first.back()), {});
    for (const CandidatePair& p : all_pairs(static_cast<std::uint32_t>(a.triangles.size()))) {
        const bool listed = is_listed(a, unproven, p);
        const bool improper =
            improper_contact(m.points, a.triangles[p.first], a.triangles[p.second]).has_value();
        found.improper += improper;
        found.missed += improper && !listed;
        found.clear += !listed;
    }
}

/// Returns a large triangle, cut by two families of triangles into more than 256 parts.
Surface much_cut(Random& random) {
    const auto near = [&](double x) { return x + random_real(random, -0.02, 0.02); };
    Surface s;
    const auto add = [&](const std::array<Point3, 3>& corners) { // made in order, unlike arguments
        const auto first = static_cast<std::uint32_t>(s.vertices.size());
        s.vertices.insert(s.vertices.end(), corners.begin(), corners.end());
        s.triangles.push_back({first, first + 1, first + 2});
    };
    add({Point3{-2, -2, near(0)}, Point3{6, -2, near(0)}, Point3{-2, 6, near(0)}});
    for (int k = 0; k < 12; ++k) {
        const double at = k / 12.0;
        add({Point3{near(at), -1.5, -1}, Point3{near(at), 2.5, -1}, Point3{near(at), 0.5, 1}});
        add({Point3{-1.5, near(at), -1}, Point3{2.5, near(at), -1}, Point3{0.5, near(at), 1}});
    }
    return s;
}

/// Returns a sheet of n by n cells whose vertices are moved up or down by `by`, at random.
Surface rough_sheet(Random& random, std::uint32_t n, double by) {
    Surface s;
    for (std::uint32_t v = 0; v <= n; ++v)
        for (std::uint32_t u = 0; u <= n; ++u)
            s.vertices.push_back(
                {u * 1.0, v * 1.0, std::sin(u + 2.0 * v) + by * random_int(random, -1, 1)});
    for (std::uint32_t v = 0; v < n; ++v)
        for (std::uint32_t u = 0; u < n; ++u) {
            const std::uint32_t a = (n + 1) * v + u, b = a + n + 1;
            s.triangles.push_back({a, a + 1, b});
            s.triangles.push_back({a + 1, b + 1, b});
        }
    return s;
}

} // namespace

TEST_CASE("clearance: sheets that are in doubt everywhere are left to tests as a whole") {
    Random random(115);
    int improper = 0;
    for (int i = 0; i < 4; ++i) {
        const Arrangement a =
            arrange(std::vector{rough_sheet(random, 16, 0), rough_sheet(random, 16, 0x1p-50)})
                .value();
        const std::span meeting(a.state->neighbours);
        REQUIRE(meeting.size() > a.triangles.size()); // otherwise each pair is looked at
        const Moved m = moved(random, a, 0x1p-50);
        const Unproven unproven =
            find_unproven({a.state->points.inputs(), a.state->corners, a.vertices, m.points,
                           m.moves, a.triangles, a.parents_of},
                          meeting, {});
        for (const CandidatePair& p :
             candidate_pairs({m.points, a.triangles}, {}, Search::automatic)) {
            if (!improper_contact(m.points, a.triangles[p.first], a.triangles[p.second])) continue;
            ++improper;
            REQUIRE(is_listed(a, unproven, p));
        }
        CHECK(unproven.pairs.empty());
        CHECK(unproven.parts.size() > a.triangles.size() / 2);
    }
    CHECK(improper > 100);
}

TEST_CASE("clearance: the same of a face with so many parts that far ones are left out") {
    Random random(113);
    int improper = 0;
    for (int i = 0; i < 12; ++i) { // all in every build: improper pairs are rare
        const Arrangement a = arrange(std::vector{much_cut(random)}).value();
        REQUIRE(a.degenerate.empty());
        const auto of_first = std::count_if(a.parents_of.values.begin(), a.parents_of.values.end(),
                                            [](auto p) { return p == 0; });
        REQUIRE(of_first > 256);
        const Moved m = moved(random, a, std::pow(10, random_real(random, -4, -1)));
        const Unproven unproven =
            find_unproven({a.state->points.inputs(), a.state->corners, a.vertices, m.points,
                           m.moves, a.triangles, a.parents_of},
                          all_pairs(a.inputs.first.back()), {});
        const auto pairs = candidate_pairs({m.points, a.triangles}, {}, Search::automatic);
        for (const CandidatePair& p : pairs) {
            if (!improper_contact(m.points, a.triangles[p.first], a.triangles[p.second])) continue;
            ++improper;
            REQUIRE(is_listed(a, unproven, p));
        }
        CHECK(unproven.parts.size() < a.triangles.size());
    }
    CHECK(improper > 20);
}

TEST_CASE("clearance: what is not listed as unproven is proper") {
    Random random(111);
    for (const Shape shape : all_shapes) {
        Found found;
        for (int i = 0; i < 1200; ++i) { // all in every build: improper pairs are rare
            const double size = std::pow(10, random_real(random, -16, 0));
            const Surface surface =
                shape == Shape::of_a_sheet ? crossed_sheet(random) : loose(random, shape);
            examine(random, surface, size, found);
            INFO("shape " << static_cast<int>(shape) << ", case " << i << ", moved by " << size);
            REQUIRE(found.missed == 0);
        }
        INFO("shape " << static_cast<int>(shape));
        CHECK(found.improper > 0);
        CHECK(found.clear > found.improper);
    }
}

TEST_CASE("clearance: two triangles that cross at a small angle, in a short line, or hardly miss",
          "[once]") {
    Random random(114);
    Found found;
    const auto flat = [&](double tilt) {
        return Point3{random_real(random, 0, 1), random_real(random, 0, 1),
                      random_real(random, -tilt, tilt)};
    };
    for (int i = 0; i < 20'000; ++i) { // all in every build: improper pairs are rare
        Surface s;
        const double tilt = std::pow(10, random_real(random, -6, 0));
        for (int v = 0; v < 6; ++v) s.vertices.push_back(flat(tilt));
        if (i % 2 == 0) { // two edges that cross, or just miss each other
            const double at = random_real(random, 0, 1), near = random_real(random, -0.01, 0.01);
            const Point3 x = between(s.vertices[0], s.vertices[1], at);
            s.vertices[4] = between(s.vertices[3], between(s.vertices[2], x, 1 + near), 2);
        }
        s.triangles = {{0, 1, 2}, {3, 4, 5}};
        examine(random, s, tilt * std::pow(10, random_real(random, -5, 0)), found);
        INFO("case " << i);
        REQUIRE(found.missed == 0);
    }
    CHECK(found.improper > 100);
    CHECK(found.clear > found.improper);
}

TEST_CASE("clearance: hardly any part of a smooth sheet is unproven after rounding") {
    Random random(112);
    std::size_t unclear_pairs = 0, parts = 0;
    for (int i = 0; i < cases(200); ++i) {
        const Arrangement a = arrange(std::vector{crossed_sheet(random)}).value();
        const Moved m = moved(random, a, 1e-15);
        const Unproven unproven =
            find_unproven({a.state->points.inputs(), a.state->corners, a.vertices, m.points,
                           m.moves, a.triangles, a.parents_of},
                          all_pairs(a.inputs.first.back()), {});
        unclear_pairs += unproven.pairs.size();
        parts += a.triangles.size();
    }
    CHECK(unclear_pairs < parts / 5);
}
