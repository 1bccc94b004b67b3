// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Compares what a sweep along the line of a pencil finds with what a test of every pair finds.
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/soup_laws.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/intersection/pencils.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

namespace {

using namespace terrane;
using namespace test_support;

Point3 sum(const Point3& a, double s, const Point3& b, double t, const Point3& c) {
    return {a.x + s * b.x + t * c.x, a.y + s * b.y + t * c.y, a.z + s * b.z + t * c.z};
}

void add(Surface& s, const Point3& a, const Point3& b, const Point3& c) {
    const auto first = static_cast<std::uint32_t>(s.vertices.size());
    s.vertices.insert(s.vertices.end(), {a, b, c});
    s.triangles.push_back({first, first + 1, first + 2});
}

/// Triangles with integer corners in planes through one line, and some that are not. Many
/// have corners or edges on the line, or stop short of it, and many lie in one plane.
std::vector<Surface> random_pencils(Random& random) {
    const auto integer = [&](int size) { return double(random_int(random, -size, size)); };
    const auto vector = [&](int size) { return point_of([&] { return integer(size); }); };
    std::vector<Surface> surfaces(2);
    const int planes = random_int(random, 100, 300);
    const bool has_second = random_int(random, 0, 3) == 0;
    for (int l = 0; l < (has_second ? 2 : 1); ++l) {
        const Point3 origin = vector(4), along = vector(2);
        std::vector<Point3> across;
        for (int p = 0; p < planes; ++p) across.push_back(vector(9));
        const int count = l == 0 ? random_int(random, 300, 450) : 8;
        for (int i = 0; i < count; ++i) {
            const Point3& to = across[static_cast<std::size_t>(random_int(random, 0, planes - 1))];
            const int lowest = random_int(random, 0, 4) == 0 ? 0 : -3;
            const auto corner = [&] {
                return sum(origin, integer(3), along, random_int(random, lowest, 3), to);
            };
            add(surfaces[i % 2 == 0 ? 0 : 1], corner(), corner(), corner());
        }
    }
    for (int i = random_int(random, 0, 3); i > 0; --i)
        add(surfaces[0], vector(9), vector(9), vector(9));
    return surfaces;
}

/// Judges the arrangement and its rounding by the verifier, which tests pairs one by one, and compares
/// it with those by other methods of search. Returns how many pairs were not looked at.
std::size_t judge(const std::vector<Surface>& surfaces) {
    const auto arranged = arrange(surfaces),
               by_brute = arrange(surfaces, {.search = Search::brute});
    REQUIRE(arranged);
    REQUIRE(by_brute);
    const Arrangement& a = arranged.value();
    REQUIRE(soup_laws::arrangement_flaw(surfaces, a).empty());
    REQUIRE((by_brute.value().triangles == a.triangles));
    const auto rounded = round_to_doubles(a);
    REQUIRE(rounded);
    if (rounded.value().report.clean) {
        const Mesh& mesh = *rounded.value().mesh;
        CHECK(conforming(mesh.vertices, mesh.triangles, {}, {.method = PairCheck::full}));
    }
    const Soup soup = merge_surfaces(surfaces);
    const auto all = candidate_pairs({soup.points, soup.triangles}, {}, Search::brute);
    return all.size() - a.statistics.candidates;
}

std::vector<Surface> star(int n, double shift) {
    Surface s;
    for (int i = 0; i < n; ++i) {
        const double angle = M_PI * i / n, x = std::cos(angle), y = std::sin(angle);
        add(s, {-x, -y, shift}, {x, y, shift}, {x, y, shift + 1});
        add(s, {-x, -y, shift}, {x, y, shift + 1}, {-x, -y, shift + 1});
    }
    return {s};
}

} // namespace

TEST_CASE("pencils: a sweep finds what a test of every pair finds", "[once]") {
    Random random(20263);
    std::size_t left_out = 0;
    for (int k = 0; k < cases(1); ++k) {
        INFO("case " << k);
        left_out += judge(random_pencils(random));
    }
    CHECK(left_out > 0); // else the test would say nothing
}

TEST_CASE("pencils: planes through one line cost little, and are divided along it", "[once]") {
    const auto surfaces = star(400, 0);
    CHECK(judge(surfaces) > 300'000); // of 319 600
    const auto arranged = arrange(surfaces);
    CHECK(arranged.value().triangles.size() == 2400);
}

TEST_CASE("pencils: a line that none of the triangles reaches") {
    // Planes through the z axis, triangles off it: nothing is divided.
    Surface s;
    for (int i = 0; i < 400; ++i) {
        const double x = 1 + i % 20, y = 1 + i / 20;
        add(s, {x, y, 0}, {2 * x, 2 * y, 0}, {x, y, 40});
    }
    judge({s});
}

TEST_CASE("pencils: planes and their order are found, and the same for any order of triangles") {
    const auto surfaces = star(150, 2);
    const Surface& s = surfaces[0];
    std::vector<std::uint32_t> all(s.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    const Pencils found = find_pencils({s.vertices, s.triangles}, all, {});
    REQUIRE(found.list.size() == 1);
    const Pencil& pencil = found.list[0];
    CHECK(pencil.triangles == all);
    for (std::size_t k = 0; k < all.size(); k += 2) { // the two of a rectangle
        CHECK(pencil.plane_of[k] == pencil.plane_of[k + 1]);
        for (std::size_t j = 0; j < k; j += 2)
            CHECK_FALSE(pencil.plane_of[j] == pencil.plane_of[k]);
    }
    CHECK(coplanar_pairs({s.vertices, s.triangles}, found, {}, {}).size() == 150);
}
