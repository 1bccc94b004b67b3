// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/holes/holes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stop_token>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/loops.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

using namespace terrane;
using namespace test_support;

namespace {

constexpr auto all = [](int, int) { return true; };
constexpr auto flat = [](double, double) { return 0.0; };

std::size_t count(const std::vector<BorderLoop>& loops, LoopKind kind) {
    return static_cast<std::size_t>(std::count_if(
        loops.begin(), loops.end(), [&](const BorderLoop& l) { return l.kind == kind; }));
}

Edge edge_between(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
}

/// Finds the edges of one triangle by brute force.
std::set<Edge> free_edges(const Surface& s) {
    std::map<Edge, int> sides;
    for (const Triangle& t : s.triangles)
        for (unsigned i = 0; i < 3; ++i) ++sides[edge_between(t[i], t[(i + 1) % 3])];
    std::set<Edge> result;
    for (const auto& [edge, count] : sides)
        if (count == 1) result.insert(edge);
    return result;
}

Point3 vector_area(const std::vector<Point3>& points) {
    Point3 sum{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point3 c = cross(points[i], points[(i + 1) % points.size()]);
        sum = {sum.x + c.x / 2, sum.y + c.y / 2, sum.z + c.z / 2};
    }
    return sum;
}

Point3 vector_area(const Surface& s, const BorderLoop& loop) {
    std::vector<Point3> points;
    for (const auto v : loop.vertices) points.push_back(s.vertices[v]);
    return vector_area(points);
}

/// Lists the points of a loop from the lowest one on, which must not depend on indices.
std::vector<std::vector<Point3>> canonical(const Surface& s, const std::vector<BorderLoop>& loops) {
    std::vector<std::vector<Point3>> result;
    for (const auto& loop : loops) {
        std::vector<Point3> points;
        for (const auto v : loop.vertices) points.push_back(s.vertices[v]);
        std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
        result.push_back(points);
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// Builds a sheet torn along a band of cells, `columns` wide, with one side lifted.
Surface torn(double lift, int columns, double tilt = 0) {
    const auto keep = [=](int i, int j) { return i < 14 || i >= 14 + columns || j < 5 || j >= 25; };
    return sheet(30, 30, 10, keep, [=](double x, double y) {
        const double inside = std::clamp(std::min(y - 50, 250 - y) / 50, 0.0, 1.0);
        return (x > 145 ? lift * inside : 0) + tilt * x;
    });
}

} // namespace

TEST_CASE("holes: a square hole in a sheet is found and measured", "[holes]") {
    const auto keep = [](int i, int j) { return i < 3 || i > 4 || j < 4 || j > 6; };
    const Surface s = sheet(10, 12, 2, keep, flat);
    const auto loops = loops_of(s);
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].kind == LoopKind::outer);
    CHECK(loops[0].length == 2 * (20 + 24));
    CHECK(loops[0].area == 20 * 24);
    CHECK(loops[1].kind == LoopKind::hole);
    CHECK(loops[1].length == 2 * (4 + 6));
    CHECK(loops[1].area == 4 * 6);
    CHECK(loops[1].centre == Point3{8, 11, 0});
    CHECK(loops[1].vertices.size() == 10);
    CHECK(vector_area(s, loops[0]).z > 0); // the surface is on the left
    CHECK(vector_area(s, loops[1]).z < 0);
}

TEST_CASE("holes: each border edge is in one loop, once, and the loops bound the surface",
          "[holes]") {
    Random random(5);
    for (int n = 0; n < cases(300); ++n) {
        const int columns = random_int(random, 1, 9), rows = random_int(random, 1, 9);
        const int density = random_int(random, 1, 9);
        const auto keep = [&](int, int) { return random_int(random, 0, 9) <= density; };
        const auto z = [&](double, double) { return random_real(random, -1, 1); };
        const Surface s = sheet(columns, rows, 1, keep, z);
        const auto loops = loops_of(s);
        std::multiset<Edge> edges;
        Point3 sum{};
        for (const auto& loop : loops) {
            CHECK(std::set(loop.vertices.begin(), loop.vertices.end()).size() ==
                  loop.vertices.size());
            for (std::size_t i = 0; i < loop.vertices.size(); ++i)
                edges.insert(
                    edge_between(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]));
            const Point3 area = vector_area(s, loop);
            sum = {sum.x + area.x, sum.y + area.y, sum.z + area.z};
        }
        const auto expected = free_edges(s);
        CHECK(std::vector(edges.begin(), edges.end()) ==
              std::vector(expected.begin(), expected.end()));
        Point3 total{};
        for (const Triangle& t : s.triangles) {
            const Point3 area = vector_area({s.vertices[t[0]], s.vertices[t[1]], s.vertices[t[2]]});
            total = {total.x + area.x, total.y + area.y, total.z + area.z};
        }
        CHECK(std::abs(total.x - sum.x) < 1e-9);
        CHECK(std::abs(total.y - sum.y) < 1e-9);
        CHECK(std::abs(total.z - sum.z) < 1e-9);
    }
}

TEST_CASE("holes: neither the numbers of vertices, nor their copies, nor the order of triangles "
          "change the loops",
          "[holes]") {
    Random random(7);
    const Surface s = sheet(
        12, 9, 1, [&](int, int) { return random_int(random, 0, 5) > 0; },
        [](double x, double y) { return std::sin(x) * std::cos(y); });
    Surface soup{s.name, s.role, {}, {}}; // no two triangles share vertices
    auto triangles = s.triangles;
    std::shuffle(triangles.begin(), triangles.end(), random);
    for (const Triangle& t : triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const auto v : t) soup.vertices.push_back(s.vertices[v]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    soup.triangles.push_back(soup.triangles.front()); // repeated triangles are ignored
    CHECK(canonical(s, loops_of(s)) == canonical(soup, loops_of(soup)));
}

TEST_CASE("holes: two holes that touch in a corner are two loops", "[holes]") {
    const auto keep = [](int i, int j) { return !(i == j && (i == 2 || i == 3)); };
    const auto loops = loops_of(sheet(6, 6, 1, keep, flat));
    REQUIRE(loops.size() == 3);
    CHECK(count(loops, LoopKind::hole) == 2);
    CHECK(loops[1].area == 1);
    CHECK(loops[2].area == 1);
}

TEST_CASE("holes: an island in a hole is a part with its own outer border", "[holes]") {
    const auto keep = [](int i, int j) {
        const int ring = std::max(std::abs(i - 5), std::abs(j - 5));
        return ring < 2 || ring > 3;
    };
    const auto loops = loops_of(sheet(11, 11, 1, keep, flat));
    CHECK(count(loops, LoopKind::outer) == 2);
    CHECK(count(loops, LoopKind::hole) == 1);
    CHECK(loops[0].part != loops[1].part);
}

TEST_CASE("holes: a Moebius strip has one border, a closed body none, a punctured one a hole",
          "[holes]") {
    Surface strip{"strip", Role::unknown, {}, {}};
    constexpr std::uint32_t n = 12;
    for (std::uint32_t i = 0; i < n; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double turn = 2 * M_PI * i / n, r = 4 + side * std::cos(turn / 2);
            strip.vertices.push_back(
                {r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const auto a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        strip.triangles.push_back({a, b, c});
        strip.triangles.push_back({b, d, c});
    }
    const auto loops = loops_of(strip);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0].vertices.size() == 2 * n);

    // A cube of many squares: six sheets, which share only points.
    Surface cube{"cube", Role::unknown, {}, {}};
    for (int face = 0; face < 6; ++face) {
        const auto at = [&](double x, double y) {
            const double z = face < 3 ? 0 : 4;
            const std::array<double, 3> p{x, y, z};
            const int k = face % 3;
            return Point3{p[unsigned(3 - k) % 3], p[unsigned(4 - k) % 3], p[unsigned(5 - k) % 3]};
        };
        const Surface s = sheet_of(4, 4, 1, all, at);
        const auto first = static_cast<std::uint32_t>(cube.vertices.size());
        cube.vertices.insert(cube.vertices.end(), s.vertices.begin(), s.vertices.end());
        for (const Triangle& t : s.triangles)
            cube.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    CHECK(loops_of(cube).empty());
    cube.triangles.pop_back();
    const auto punctured = loops_of(cube);
    REQUIRE(punctured.size() == 1);
    CHECK(punctured[0].kind == LoopKind::hole);
}

TEST_CASE("holes: the border at which a flap is attached is never a hole", "[holes]") {
    Surface s = sheet(6, 6, 1, all, flat);
    const auto find = [&](double x, double y) {
        const auto at = std::find(s.vertices.begin(), s.vertices.end(), Point3{x, y, 0});
        return static_cast<std::uint32_t>(at - s.vertices.begin());
    };
    const auto top = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.push_back({3, 3, 2});
    s.triangles.push_back({find(2, 3), find(3, 3), top});
    s.triangles.push_back({find(3, 3), find(4, 3), top});
    const auto loops = loops_of(s);
    REQUIRE(loops.size() == 2);
    CHECK(count(loops, LoopKind::outer) == 2);
    CHECK(loops[0].vertices.size() == 24);
    CHECK(loops[0].shared == 0);
    CHECK(loops[1].vertices.size() == 4);
    CHECK(loops[1].shared == 2);
}

TEST_CASE(
    "holes: a gap with a throw is a fault gap, whatever its tilt; without a throw it is a hole",
    "[holes]") {
    for (const double tilt : {0.0, 0.5, -0.4})
        for (const int columns : {1, 2}) {
            const auto gap = loops_of(torn(60, columns, tilt));
            REQUIRE(gap.size() == 2);
            CHECK(gap[1].kind == LoopKind::fault_gap);
            if (tilt == 0) CHECK(gap[1].width >= 10 * columns);
            const auto hole = loops_of(torn(0, columns, tilt));
            REQUIRE(hole.size() == 2);
            CHECK(hole[1].kind == LoopKind::hole);
            CHECK(hole[1].fault_throw < 1e-9);
        }
    const auto gap = loops_of(torn(60, 2));
    CHECK(gap[1].fault_throw == Approx(60).epsilon(0.1));
    const auto patient = find_border_loops(torn(60, 2), {}, {.slope = 10});
    REQUIRE(patient);
    CHECK(patient.value()[1].kind == LoopKind::hole);
}

TEST_CASE("holes: smooth relief does not turn a hole into a fault gap", "[holes]") {
    for (const double radius : {2.5, 4.5, 6.5})
        for (int at = 8; at < 20; at += 3) {
            const auto wave = [](double x, double y) {
                return 20 * std::sin(x / 40) * std::cos(y / 55);
            };
            const auto loops = loops_of(sheet(30, 30, 10, without_disc(at, 15, radius), wave));
            REQUIRE(loops.size() == 2);
            CHECK(loops[1].kind == LoopKind::hole);
        }
}

TEST_CASE("holes: invalid surfaces are refused, and a stop request is obeyed", "[holes]") {
    Surface s = sheet(3, 3, 1, all, flat);
    s.vertices[4].z = NAN;
    CHECK(find_border_loops(s).error().code == ErrorCode::bad_number);
    s.vertices[4].z = 0;
    s.triangles[2][1] = 99;
    CHECK(find_border_loops(s).error().code == ErrorCode::bad_index);
    s.triangles.erase(s.triangles.begin() + 2);
    std::stop_source source;
    source.request_stop();
    CHECK(find_border_loops(s, {.stop = source.get_token()}).error().code ==
          ErrorCode::interrupted);
}
