// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Small models with every kind of contact: the verifier judges each one, and the counts are fixed.
#include "support/claim.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>

namespace {

using namespace terrane;
using namespace test_support;

Surface triangle(const Point3& a, const Point3& b, const Point3& c) {
    return surface({a, b, c}, {{0, 1, 2}});
}

struct Counts {
    std::size_t vertices, triangles, intersection_edges;
    friend bool operator==(const Counts&, const Counts&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
        return out << c.vertices << " vertices, " << c.triangles << " triangles, "
                   << c.intersection_edges << " intersection edges";
    }
};

/// Arranges the surfaces, has the result verified, and counts.
Counts counts_of_arrangement(const std::vector<Surface>& surfaces) {
    const auto a = arrange(surfaces);
    REQUIRE(a);
    REQUIRE(flaws(surfaces, a.value()) == "");
    return {a.value().vertices.size(), a.value().triangles.size(),
            a.value().intersection_edges.size()};
}

const Surface floor_triangle = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

} // namespace

TEST_CASE("arrange: nothing, one triangle, one and its neighbours") {
    CHECK(counts_of_arrangement({}) == Counts{0, 0, 0});
    CHECK(counts_of_arrangement({surface({}, {})}) == Counts{0, 0, 0});
    CHECK(counts_of_arrangement({surface({{1, 2, 3}}, {})}) == Counts{0, 0, 0});
    CHECK(counts_of_arrangement({floor_triangle}) == Counts{3, 1, 0});
    CHECK(counts_of_arrangement({surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 5}},
                                         {{0, 1, 2}, {1, 3, 2}})}) == Counts{4, 2, 0});
    CHECK(counts_of_arrangement({floor_triangle, triangle({0, 0, 9}, {4, 0, 9}, {0, 4, 9})}) ==
          Counts{6, 2, 0});
}

TEST_CASE("arrange: shared vertex, shared edge, of two surfaces") {
    CHECK(counts_of_arrangement({floor_triangle, triangle({0, 0, 0}, {-1, 0, 1}, {0, -1, 1})}) ==
          Counts{5, 2, 0});
    CHECK(counts_of_arrangement({floor_triangle, triangle({0, 0, 0}, {4, 0, 0}, {0, 0, 4})}) ==
          Counts{4, 2, 1});
}

TEST_CASE("arrange: vertex on edge, vertex on face") {
    CHECK(counts_of_arrangement({floor_triangle, triangle({2, 0, 0}, {2, 0, 1}, {2, -1, 1})}) ==
          Counts{6, 3, 0});
    CHECK(counts_of_arrangement({floor_triangle, triangle({1, 1, 0}, {5, 5, 5}, {6, 5, 5})}) ==
          Counts{6, 4, 0});
}

TEST_CASE("arrange: edges cross, an edge through a face, an edge on a face") {
    CHECK(counts_of_arrangement({floor_triangle, triangle({2, 0, -1}, {2, 0, 1}, {2, -5, 0})}) ==
          Counts{7, 4, 0});
    CHECK(counts_of_arrangement({floor_triangle, triangle({1, 1, -1}, {1, 1, 1}, {2, 1, 1})}) ==
          Counts{8, 8, 1});
    CHECK(counts_of_arrangement({floor_triangle, triangle({1, 1, 0}, {2, 1, 0}, {1, 1, 3})}) ==
          Counts{6, 6, 1});
    CHECK(counts_of_arrangement({floor_triangle, triangle({2, 0, 0}, {6, 0, 0}, {1, 0, 3})}) ==
          Counts{6, 4, 1});
}

TEST_CASE("arrange: a shared vertex and a crossing; folded over a shared edge") {
    CHECK(counts_of_arrangement({floor_triangle, triangle({0, 0, 0}, {1, 1, -1}, {1, 1, 1})}) ==
          Counts{6, 5, 1});
    CHECK(counts_of_arrangement(
              {surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}})}) ==
          Counts{4, 3, 2}); // the shared edge has one triangle
}

TEST_CASE("arrange: coplanar overlap, of either orientation, in part and as a whole") {
    const Point3 a{1, 1, 0}, b{5, 1, 0}, c{1, 5, 0};
    const Counts part = counts_of_arrangement({floor_triangle, triangle(a, b, c)});
    CHECK(part == Counts{8, 7, 3});
    CHECK(counts_of_arrangement({floor_triangle, triangle(a, c, b)}) == part);
    CHECK(counts_of_arrangement({floor_triangle, triangle({1, 1, 0}, {2, 1, 0}, {1, 2, 0})}) ==
          Counts{6, 7, 3});
    const Counts star =
        counts_of_arrangement({floor_triangle, triangle({3, 3, 0}, {-1, 3, 0}, {3, -1, 0})});
    CHECK(star.vertices == 12);
    CHECK(star.triangles == 6 + 4); // six tips, four within the hexagon
    CHECK(star.intersection_edges == 6);
}

TEST_CASE("arrange: a stack of three coplanar sheets names all parents") {
    const std::vector<Surface> stack{floor_triangle, triangle({0, 0, 0}, {0, 4, 0}, {4, 0, 0}),
                                     triangle({1, 1, 0}, {2, 1, 0}, {1, 2, 0}),
                                     triangle({0, 1, 0}, {4, 1, 0}, {0, 2, 0})};
    const auto a = arrange(stack);
    REQUIRE(a);
    CHECK(flaws(stack, a.value()) == "");
    CHECK(a.value().inputs.duplicates == std::vector<std::array<std::uint32_t, 2>>{{1, 0}});
    std::size_t most = 0;
    for (std::size_t t = 0; t < a.value().triangles.size(); ++t)
        most = std::max(most, a.value().parents_of[t].size());
    CHECK(most == 4);
}

TEST_CASE("arrange: degenerate and duplicate triangles are set aside and named") {
    const std::vector<Surface> surfaces{
        surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {0, 0, 0}},
                {{0, 3, 1}, {0, 1, 2}, {0, 0, 1}, {4, 1, 2}, {0, 4, 2}}),
        triangle({4, 0, 0}, {0, 0, 0}, {0, 4, 0}), triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1})};
    const auto a = arrange(surfaces);
    REQUIRE(a);
    CHECK(flaws(surfaces, a.value()) == "");
    CHECK(a.value().degenerate == std::vector<std::uint32_t>{0, 2, 4, 6});
    CHECK(a.value().inputs.duplicates == std::vector<std::array<std::uint32_t, 2>>{{3, 1}, {5, 1}});
    CHECK(a.value().triangles.size() == 1);
    CHECK(a.value().vertices.size() == 3);
    CHECK(arrange(std::vector{surface({{1, 1, 1}}, {{0, 0, 0}})}).value().triangles.empty());
}

TEST_CASE("arrange: three surfaces through one point, and four planes") {
    const std::vector<Surface> three{triangle({-4, -4, 0}, {4, -4, 0}, {0, 8, 0}),
                                     triangle({-4, 0, -4}, {4, 0, -4}, {0, 0, 8}),
                                     triangle({0, -4, -4}, {0, 4, -4}, {0, 0, 8})};
    counts_of_arrangement(three);
    auto four = three;
    four.push_back(triangle({-5, 5, 1}, {5, -5, 1}, {1, 1, -2})); // also through the origin
    for (auto& p : four.back().vertices) p.z = -p.x - p.y;
    counts_of_arrangement(four);
    const auto a = arrange(four);
    int origins = 0;
    for (const PointIndex p : a.value().vertices)
        origins += a.value().state->points.nearest(p) == Point3{};
    CHECK(origins == 1);
}

TEST_CASE("arrange: constraints cross within a triangle, in points of three planes") {
    const std::vector<Surface> surfaces{
        triangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}), triangle({1, 2, -3}, {7, 2, -2}, {3, 2, 5}),
        triangle({2, 1, -2}, {2, 7, -3}, {2, 3, 5}), triangle({1, 1, -1}, {4, 5, -1}, {3, 3, 5})};
    const auto a = arrange(surfaces);
    REQUIRE(a);
    CHECK(flaws(surfaces, a.value()) == "");
    int of_three_planes = 0;
    for (const PointIndex p : a.value().vertices)
        of_three_planes +=
            a.value().state->points.construction(p).kind == Construction::Kind::three_planes;
    CHECK(of_three_planes > 0);
}

TEST_CASE("arrange: a surface that crosses itself, and one with a Moebius twist") {
    counts_of_arrangement(
        {surface({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 2, 1}, {2, 1, 1}},
                 {{0, 1, 2}, {3, 4, 5}})});
    Surface strip;
    for (int i = 0; i < 9; ++i) {
        const double t = i * 0.75, c = std::cos(t), s = std::sin(t), h = t / 2;
        for (const double w : {-0.5, 0.5})
            strip.vertices.push_back(
                {(3 + w * std::cos(h)) * c, (3 + w * std::cos(h)) * s, w * std::sin(h)});
    }
    for (std::uint32_t k = 0; k + 3 < strip.vertices.size(); k += 2) {
        strip.triangles.push_back({k, k + 1, k + 2});
        strip.triangles.push_back({k + 1, k + 3, k + 2});
    }
    counts_of_arrangement({strip, triangle({-9, -9, 0.1}, {9, -9, 0.1}, {0, 9, 0.1})});
}

TEST_CASE("arrange: an arrangement of doubles is its own arrangement") {
    // All intersection points of these are integers.
    const std::vector<Surface> surfaces{triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0}),
                                        triangle({2, 0, -2}, {2, 0, 2}, {2, 8, 0})};
    const auto once = arrange(surfaces);
    REQUIRE(once);
    Surface flat;
    for (const PointIndex p : once.value().vertices)
        flat.vertices.push_back(once.value().state->points.nearest(p));
    flat.triangles = once.value().triangles;
    const auto twice = arrange(std::vector{flat});
    REQUIRE(twice);
    CHECK(twice.value().triangles == flat.triangles);
    CHECK(twice.value().state->points.size() == flat.vertices.size());
}

TEST_CASE("arrange: bad input is named by place") {
    const auto refuse = [](const Surface& bad) {
        const auto a = arrange(std::vector{floor_triangle, bad});
        REQUIRE_FALSE(a);
        return a.error();
    };
    Surface bad = floor_triangle;
    bad.name = "fault";
    for (const double d : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        bad.vertices[1].z = d;
        CHECK(refuse(bad).code == ErrorCode::bad_number);
        CHECK(refuse(bad).place == "surface fault, vertex 1");
    }
    bad.vertices[1].z = 0;
    bad.triangles.push_back({0, 3, 1});
    CHECK(refuse(bad).code == ErrorCode::bad_index);
    CHECK(refuse(bad).place == "surface fault, triangle 1");
}

TEST_CASE("arrange: a stop request ends it") {
    std::stop_source source;
    source.request_stop();
    const Run run{.threads = 1, .stop = source.get_token(), .progress = {}};
    const auto a = arrange(std::vector{floor_triangle}, {}, run);
    REQUIRE_FALSE(a);
    CHECK(a.error().code == ErrorCode::interrupted);
    // A stop request in the middle of the work.
    std::stop_source later;
    const Run stopped{.threads = 2, .stop = later.get_token(), .progress = [&](auto, double share) {
                          if (share > 0.2) later.request_stop();
                      }};
    const auto b = arrange(std::vector{floor_triangle}, {}, stopped);
    REQUIRE_FALSE(b);
    CHECK(b.error().code == ErrorCode::interrupted);
}

TEST_CASE("arrange: progress ascends to 1") {
    std::vector<double> shares;
    const Run run{.threads = 1, .stop = {}, .progress = [&](auto stage, double share) {
                      CHECK(stage == "arrange");
                      shares.push_back(share);
                  }};
    REQUIRE(arrange(std::vector{floor_triangle}, {}, run));
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1);
}

TEST_CASE("arrange: progress is told within its long steps") {
    constexpr int size = 100; // 40 000 triangles, each of which is divided
    const auto crumpled = [](double height) {
        return sheet_of(
            size, size, 1.0, [](int, int) { return true; },
            [height](double x, double y) {
                return Point3{x, y, std::fmod(x + y, 2) == 0 ? height : -height};
            });
    };
    std::vector<double> shares;
    const Run run{
        .threads = 2, .stop = {}, .progress = [&](auto, double share) { shares.push_back(share); }};
    const auto arranged = arrange(std::vector{crumpled(1), crumpled(-1)}, {}, run);
    REQUIRE(arranged);
    CHECK(arranged->statistics.divided == 4 * size * size);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(std::ranges::count_if(shares, [](double s) { return s > 0.1 && s < 0.3; }) >= 2);
    CHECK(std::ranges::count_if(shares, [](double s) { return s > 0.3 && s < 0.85; }) >= 4);
    CHECK(shares.back() == 1);
}

TEST_CASE("arrange: threads may share out the triangles in front of a divided one") {
    constexpr int size = 64; // 8192 triangles, of which the middle row is cut
    Surface sheet = sheet_of(
        size, size, 1.0, [](int, int) { return true; },
        [](double x, double y) {
            return Point3{x, y, 0};
        });
    const double y = size / 2.0 + 0.25;
    const std::vector<Surface> surfaces{sheet,
                                        triangle({-200, y, -300}, {200, y, -300}, {32, y, 300})};
    const Arrangement one = arrange(surfaces).value();
    CHECK(one.statistics.divided == 2 * size + 1);
    for (const unsigned threads : {2U, 3U, 4U}) {
        const Arrangement several = arrange(surfaces, {}, {.threads = threads}).value();
        CHECK(several.triangles == one.triangles);
        CHECK(several.parents_of == one.parents_of);
        CHECK(several.state->adjacency.edges == one.state->adjacency.edges);
    }
}
