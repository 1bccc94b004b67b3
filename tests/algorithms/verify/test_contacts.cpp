// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the verifier on meshes of doubles: each class of contact, and random pairs compared with an
// independent decision, which clips one triangle by the other and examines what remains.
#include <terrane/algorithms/verify/verify.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gmpxx.h>

namespace {

using namespace terrane;

struct Example {
    std::string name;
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles;
    std::string verdict; ///< violated rules, such as "R3 R5"
};

std::string verdict(const std::vector<Point3>& vertices, const std::vector<Triangle>& triangles) {
    std::set<int> rules;
    for (const Violation& v : verify_conforming(vertices, triangles)) {
        rules.insert(static_cast<int>(v.rule) + 1);
    }
    std::string result;
    for (const int rule : rules) result += (result.empty() ? "R" : " R") + std::to_string(rule);
    return result;
}

const double step = std::numeric_limits<double>::denorm_min();
const double huge = std::numeric_limits<double>::max();
const double infinity = std::numeric_limits<double>::infinity();

const std::vector<Triangle> two{{0, 1, 2}, {3, 4, 5}};       // no shared corner
const std::vector<Triangle> at_corner{{0, 1, 2}, {0, 3, 4}}; // corner 0 shared
const std::vector<Triangle> at_edge{{0, 1, 2}, {1, 0, 3}};   // edge 0, 1 shared

/// Returns six points: the triangle (0,0,0), (4,0,0), (0,4,0) and another one.
std::vector<Point3> beside_base(const Point3& a, const Point3& b, const Point3& c) {
    return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a, b, c};
}

/// Returns five points: that triangle, and another one at its corner 0.
std::vector<Point3> at_base_corner(const Point3& a, const Point3& b) {
    return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a, b};
}

std::vector<Point3> at_base_edge(const Point3& a) {
    return {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, a};
}

std::vector<Example> conforming_examples() {
    return {
        {"nothing", {}, {}, ""},
        {"apart", beside_base({5, 5, 5}, {6, 5, 5}, {5, 6, 5}), two, ""},
        {"boxes overlap", beside_base({3, 3, -1}, {4, 3, 1}, {3, 4, 1}), two, ""},
        {"coplanar, boxes overlap", beside_base({3, 3, 0}, {4, 3, 0}, {3, 4, 0}), two, ""},
        {"coplanar, a gap of one step", beside_base({0, -step, 0}, {4, -step, 0}, {2, -2, 0}), two,
         ""},
        {"parallel, a gap of one step", beside_base({0, 0, step}, {4, 0, step}, {0, 4, step}), two,
         ""},
        {"plane crosses, triangle does not", beside_base({5, 5, -1}, {5, 5, 1}, {9, 9, 0}), two,
         ""},
        {"both planes cross, side by side", beside_base({-3, 1, -1}, {-3, 1, 1}, {-1, 1, 0}), two,
         ""},
        {"corner, folded", at_base_corner({-4, 0, 3}, {0, -4, 3}), at_corner, ""},
        {"corner, coplanar", at_base_corner({-4, 0, 0}, {0, -4, 0}), at_corner, ""},
        {"corner, through the plane, beside", at_base_corner({-4, 0, 1}, {-4, 1, -1}), at_corner,
         ""},
        {"corner, steep above", at_base_corner({1, 1, 3}, {2, 1, 3}), at_corner, ""},
        {"corner, one step above", at_base_corner({1, 1, step}, {2, 1, step}), at_corner, ""},
        {"edge, flat", at_base_edge({2, -3, 0}), at_edge, ""},
        {"edge, folded by one step", at_base_edge({0, 4, step}), at_edge, ""},
        {"edge, upright", at_base_edge({1, 1, 5}), at_edge, ""},
        {"edge shared by three",
         {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, -4, 1}},
         {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}},
         ""},
        {"tetrahedron",
         {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
         {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
         ""},
        {"the full range of doubles",
         {{-huge, -huge, -huge}, {huge, -huge, -huge}, {-huge, huge, -huge}, {huge, huge, step}},
         {{0, 1, 2}, {1, 3, 2}},
         ""},
    };
}

std::vector<Example> improper_examples() {
    return {
        {"crossing", beside_base({1, 1, -1}, {1, 1, 1}, {9, 1, 0}), two, "R5"},
        {"pierced inside", beside_base({1, 1, -1}, {2, 1, -1}, {1, 1, 1}), two, "R5"},
        {"corner in the face", beside_base({1, 1, 0}, {1, 2, 5}, {2, 1, 5}), two, "R5"},
        {"corner on the edge, folded", beside_base({2, 0, 0}, {1, -1, 5}, {3, -1, 5}), two, "R5"},
        {"T-junction, flat", beside_base({2, 0, 0}, {1, -1, 0}, {3, -1, 0}), two, "R5"},
        {"T-junction of neighbours",
         {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, -3, 0}},
         {{0, 1, 2}, {0, 3, 4}},
         "R5"},
        {"corner on corner, not shared", beside_base({0, 0, 0}, {-1, 0, 1}, {0, -1, 1}), two,
         "R3 R5"},
        {"edge on edge, not shared", beside_base({0, 0, 0}, {4, 0, 0}, {2, -1, 1}), two, "R3 R5"},
        {"edge crosses edge", beside_base({2, 0, -1}, {2, 0, 1}, {2, -4, 0}), two, "R5"},
        {"edge in the face", beside_base({1, 1, 0}, {2, 1, 0}, {1, 1, 5}), two, "R5"},
        {"edge in the plane across the face", beside_base({-1, 1, 0}, {9, 1, 0}, {1, 1, 5}), two,
         "R5"},
        {"edges overlap, folded", beside_base({2, 0, 0}, {9, 0, 0}, {5, -1, 5}), two, "R5"},
        {"edges overlap, flat", beside_base({2, 0, 0}, {9, 0, 0}, {5, -1, 0}), two, "R5"},
        {"coplanar, overlap", beside_base({1, 1, 0}, {9, 1, 0}, {1, 9, 0}), two, "R5"},
        {"coplanar, inside", beside_base({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), two, "R5"},
        {"coplanar, star", beside_base({3, 3, 0}, {-1, 3, 0}, {3, -1, 0}), two, "R5"},
        {"corner shared, pierced by the opposite edge", at_base_corner({1, 1, -1}, {1, 1, 1}),
         at_corner, "R5"},
        {"corner shared, overlap along an edge", at_base_corner({2, 0, 0}, {2, -1, 5}), at_corner,
         "R5"},
        {"corner shared, corner in the face", at_base_corner({1, 1, 0}, {1, 1, 5}), at_corner,
         "R5"},
        {"corner shared, corner on the opposite edge", at_base_corner({2, 2, 0}, {5, 5, 5}),
         at_corner, "R5"},
        {"corner shared, edge through the face", at_base_corner({9, 9, 0}, {9, 9, 5}), at_corner,
         "R5"},
        {"corner shared, coplanar overlap", at_base_corner({3, 1, 0}, {3, -5, 0}), at_corner, "R5"},
        {"corner shared, coplanar within", at_base_corner({2, 1, 0}, {1, 2, 0}), at_corner, "R5"},
        {"corner shared, coplanar around", at_base_corner({9, -1, 0}, {-1, 9, 0}), at_corner, "R5"},
        {"corner shared, coplanar, one common edge ray", at_base_corner({9, 0, 0}, {5, -5, 0}),
         at_corner, "R5"},
        {"edge shared, folded over", at_base_edge({1, 1, 0}), at_edge, "R5"},
        {"edge shared, folded over, larger", at_base_edge({9, 9, 0}), at_edge, "R5"},
        {"edge shared, folded onto an edge", at_base_edge({0, 2, 0}), at_edge, "R5"},
        {"twice", at_base_edge({2, -3, 0}), {{0, 1, 2}, {1, 0, 3}, {2, 1, 0}}, "R4"},
        {"no area, collinear", {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}, "R4"},
        {"no area, corner twice", {{0, 0, 0}, {1, 1, 1}}, {{0, 1, 1}}, "R4"},
        {"unused vertex", at_base_edge({2, -3, 0}), {{0, 1, 2}}, "R3"},
        {"zero and minus zero", beside_base({-0.0, 0, -0.0}, {-1, 0, 1}, {0, -1, 1}), two, "R3 R5"},
        {"no such vertex", at_base_edge({2, -3, 0}), {{0, 1, 2}, {1, 0, 4}}, "R1"},
        {"not a number", at_base_edge({2, std::nan(""), 0}), at_edge, "R1"},
        {"infinite", at_base_edge({2, -infinity, 0}), at_edge, "R1"},
    };
}

Point3 scaled(const Point3& p, double factor) {
    return {p.x * factor, p.y * factor, p.z * factor};
}

} // namespace

TEST_CASE("verify_conforming accepts what meets properly") {
    for (const Example& example : conforming_examples()) {
        INFO(example.name);
        CHECK(verdict(example.vertices, example.triangles).empty());
    }
}

TEST_CASE("verify_conforming refutes each way to meet otherwise") {
    for (const Example& example : improper_examples()) {
        INFO(example.name);
        CHECK(verdict(example.vertices, example.triangles) == example.verdict);
    }
}

TEST_CASE("verify_conforming: order, orientation, axes and powers of two change nothing") {
    for (Example example : improper_examples()) {
        INFO(example.name);
        std::reverse(example.triangles.begin(), example.triangles.end());
        for (Triangle& t : example.triangles) t = {t[2], t[1], t[0]};
        for (const double factor : {0x1p-1070, 0x1p-30, 0x1p1000}) {
            auto vertices = example.vertices;
            for (Point3& p : vertices) {
                p = scaled(p, factor);
                p = {p.y, p.z, p.x};
            }
            CHECK(verdict(vertices, example.triangles) == example.verdict);
        }
    }
}

TEST_CASE("verify_conforming sees the last bit of a double") {
    // The plane x + y = z would contain (0.1, 0.2, 0.1 + 0.2) only if the sum were not rounded; it
    // is rounded up.
    const auto with_corner_at = [](double z) {
        return verdict({{-1, -1, -2}, {8, -1, 7}, {-1, 8, 7}, {0.1, 0.2, z}, {0, 0, 9}, {1, 0, 9}},
                       two);
    };
    CHECK(with_corner_at(0.1 + 0.2).empty());
    CHECK(with_corner_at(std::nextafter(0.1 + 0.2, 0.0)) == "R5");
    CHECK(with_corner_at(0.3) == "R5");

    const auto with_apex_at = [](double y) {
        return verdict(beside_base({1, y, 0}, {2, -1, 0}, {0, -1, 0}), two);
    };
    CHECK(with_apex_at(-step).empty());
    CHECK(with_apex_at(0) == "R5");
}

TEST_CASE("verify_conforming names all pairs, sorted") {
    // Three triangles, which do not touch each other, pierce another one.
    std::vector<Point3> vertices{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}};
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 3; ++i) {
        const double x = 1 + i;
        vertices.insert(vertices.end(), {{x, 1, -1}, {x, 2, -1}, {x, 1, 1}});
        triangles.push_back({3 * i + 3, 3 * i + 4, 3 * i + 5});
    }
    triangles.insert(triangles.begin() + 1, Triangle{0, 1, 2});
    const auto violations = verify_conforming(vertices, triangles);
    REQUIRE(violations.size() == 3);
    CHECK(violations[0].elements == std::vector<std::uint32_t>{0, 1});
    CHECK(violations[1].elements == std::vector<std::uint32_t>{1, 2});
    CHECK(violations[2].elements == std::vector<std::uint32_t>{1, 3});
    CHECK(violations[0].sentence == "triangles 0 and 1 meet other than in shared corners or edges");
}

TEST_CASE("verify_conforming finds the one bad triangle in a grid") {
    const std::uint32_t n = 20;
    std::vector<Point3> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            vertices.push_back({0.1 * i, 0.1 * j, std::sin(0.1 * i) * std::cos(0.1 * j)});
        }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t v = j * (n + 1) + i;
            triangles.push_back({v, v + 1, v + n + 2});
            triangles.push_back({v, v + n + 2, v + n + 1});
        }
    }
    REQUIRE(verdict(vertices, triangles).empty());
    for (const std::size_t t : {0U, 333U, 799U}) {
        const Point3& corner = vertices[triangles[t][1]];
        auto more_vertices = vertices;
        auto more_triangles = triangles;
        const auto v = static_cast<std::uint32_t>(vertices.size());
        more_vertices.insert(more_vertices.end(), {{corner.x, corner.y + 0.01, corner.z - 1},
                                                   {corner.x + 0.01, corner.y + 0.01, corner.z + 1},
                                                   {corner.x, corner.y + 0.02, corner.z + 1}});
        more_triangles.push_back({v, v + 1, v + 2});
        CHECK((verdict(more_vertices, more_triangles) == "R5") == (t != 799U));
    }
}

// --- An independent decision -----------------------------------------------------------------

namespace {

using Rational3 = std::array<mpq_class, 3>;
using Corners = std::array<std::array<int, 3>, 3>;

Rational3 minus(const Rational3& a, const Rational3& b) {
    return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}

Rational3 cross(const Rational3& a, const Rational3& b) {
    return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
            mpq_class(a[0] * b[1] - a[1] * b[0])};
}

mpq_class inner(const Rational3& a, const Rational3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Clips a convex polygon (or segment, or point) to the side normal . (p - origin) >= 0.
std::vector<Rational3> clip(const std::vector<Rational3>& polygon, const Rational3& normal,
                            const Rational3& origin) {
    std::vector<Rational3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Rational3& p = polygon[i];
        const Rational3& q = polygon[(i + 1) % polygon.size()];
        const mpq_class at_p = inner(normal, minus(p, origin));
        const mpq_class at_q = inner(normal, minus(q, origin));
        if (at_p >= 0) kept.push_back(p);
        if (sgn(at_p) * sgn(at_q) < 0) {
            const mpq_class part = at_p / (at_p - at_q);
            const Rational3 d = minus(q, p);
            kept.push_back({mpq_class(p[0] + part * d[0]), mpq_class(p[1] + part * d[1]),
                            mpq_class(p[2] + part * d[2])});
        }
    }
    return kept;
}

std::vector<Rational3> rational(const Corners& corners) {
    std::vector<Rational3> result;
    for (const auto& c : corners)
        result.push_back({mpq_class(c[0]), mpq_class(c[1]), mpq_class(c[2])});
    return result;
}

/// Returns the extreme points of the intersection of two triangles.
std::set<Rational3> common_part(const Corners& a, const Corners& b) {
    const auto t = rational(a);
    const Rational3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const Rational3 reverse{mpq_class(-normal[0]), mpq_class(-normal[1]), mpq_class(-normal[2])};
    auto rest = clip(clip(rational(b), normal, t[0]), reverse, t[0]);
    for (std::size_t i = 0; i < 3; ++i) {
        rest = clip(rest, cross(normal, minus(t[(i + 1) % 3], t[i])), t[i]);
    }
    return {rest.begin(), rest.end()};
}

std::set<Rational3> common_corners(const Corners& a, const Corners& b) {
    std::set<Rational3> result;
    for (const auto& p : rational(a)) {
        for (const auto& q : rational(b)) {
            if (p == q) result.insert(p);
        }
    }
    return result;
}

/// Tells whether the verifier accepts two triangles whose equal corners are one vertex.
bool accepted(const Corners& a, const Corners& b) {
    std::vector<Point3> vertices;
    std::map<std::array<int, 3>, std::uint32_t> number_of;
    std::vector<Triangle> triangles;
    for (const Corners* corners : {&a, &b}) {
        Triangle t{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& c = (*corners)[i];
            const auto next = static_cast<std::uint32_t>(vertices.size());
            const auto [place, is_new] = number_of.try_emplace(c, next);
            if (is_new) vertices.push_back(Point3{1.0 * c[0], 1.0 * c[1], 1.0 * c[2]});
            t[i] = place->second;
        }
        triangles.push_back(t);
    }
    const auto violations = verify_conforming(vertices, triangles);
    for (const Violation& v : violations) REQUIRE(v.rule == Rule::R5_contacts);
    return violations.empty();
}

/// Returns a triangle with an area and corners in 0..3, in the plane z = 0 if `flat`; some of its
/// corners are those of `near`, if given.
Corners random_triangle(std::mt19937& random, bool flat, const Corners* near) {
    for (;;) {
        Corners corners{};
        for (auto& c : corners) {
            for (int& x : c) x = static_cast<int>(random() % 4);
            if (flat) c[2] = 0;
            if (near != nullptr && random() % 3 == 0) c = (*near)[random() % 3];
        }
        const auto t = rational(corners);
        const Rational3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        if (inner(normal, normal) != 0) return corners;
    }
}

} // namespace

TEST_CASE("verify_conforming agrees with clipping on lattice triangles", "[once]") {
    std::mt19937 random(2024);
    std::map<std::pair<std::size_t, bool>, int> seen; // {shared corners, proper}
    for (int i = 0; i < 24'000; ++i) {
        const bool flat = i % 3 == 0;
        const Corners a = random_triangle(random, flat, nullptr);
        const Corners b = random_triangle(random, flat, i % 2 == 0 ? &a : nullptr);
        const auto shared = common_corners(a, b);
        if (shared.size() == 3) continue;
        const bool proper = common_part(a, b) == shared;
        ++seen[{shared.size(), proper}];
        if (accepted(a, b) != proper || accepted(b, a) != proper) {
            CAPTURE(a, b, flat, proper);
            FAIL("the verifier and clipping disagree");
        }
    }
    for (std::size_t shared = 0; shared < 3; ++shared) {
        CHECK(seen[{shared, true}] > 200);
        CHECK(seen[{shared, false}] > 200);
    }
}
