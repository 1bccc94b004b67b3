// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Faces with any number of corners: their triangles cover the inside of the border and nothing else. The judge
// uses integers: triangles that all face the side of the border's vector area, and whose directed edges
// cancel but for the border, cover each place as often as the border winds round it, which is once or never.
#include "support/effort.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <terrane/algorithms/triangulation/face.hpp>

namespace face_test {

using namespace terrane;

namespace {

using Whole = std::array<std::int64_t, 3>;
using Border = std::vector<Point3>;

Whole whole(const Point3& p) {
    return {static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y),
            static_cast<std::int64_t>(p.z)};
}

/// Twice the vector area of a closed line.
Whole area_of(const Border& border) {
    Whole sum{};
    for (std::size_t i = 0; i < border.size(); ++i) {
        const Whole a = whole(border[i]), b = whole(border[(i + 1) % border.size()]);
        for (std::size_t k = 0; k < 3; ++k)
            sum[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    return sum;
}

std::int64_t dot(const Whole& a, const Whole& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Adds the directed edges of a closed line, less those that are there the other way.
void add_edges(const Border& border, int times, std::map<std::pair<Point3, Point3>, int>& edges) {
    for (std::size_t i = 0; i < border.size(); ++i) {
        const Point3 &a = border[i], &b = border[(i + 1) % border.size()];
        if (a < b) edges[{a, b}] += times;
        if (b < a) edges[{b, a}] -= times;
    }
}

/// Returns what is wrong with the triangles of a face; empty if nothing is.
std::string flaw_of(const Border& border) {
    std::vector<std::uint32_t> corners(border.size());
    std::iota(corners.begin(), corners.end(), 0U);
    std::vector<Triangle> triangles;
    if (append_face(border, corners, triangles) != FaceFlaw::none) return "is said to be flawed";
    const Whole area = area_of(border);
    std::map<std::pair<Point3, Point3>, int> edges;
    add_edges(border, 1, edges);
    for (const auto& [a, b, c] : triangles) {
        const Border triangle{border[a], border[b], border[c]};
        if (dot(area_of(triangle), area) <= 0) return "a triangle faces another side";
        add_edges(triangle, -1, edges);
    }
    for (const auto& [edge, times] : edges)
        if (times != 0) return "the border of the triangles is another";
    return "";
}

/// Puts points of a plane into space, so that its normal is nearest to any of the axes.
Border in_space(const Border& flat, unsigned way) {
    Border result;
    for (const Point3& p : flat) {
        const double lift = 2 * p.x - 3 * p.y;
        const std::array<Point3, 6> places{Point3{p.x, p.y, 0}, Point3{p.x, p.y, lift},
                                           Point3{0, p.x, p.y}, Point3{lift, p.y, p.x},
                                           Point3{p.y, 7, p.x}, Point3{p.x, -lift, p.y}};
        result.push_back(places[way % places.size()]);
    }
    return result;
}

/// Checks a border from each corner on, both ways round, and in six planes.
void check_border(const Border& flat) {
    for (unsigned way = 0; way < 6; ++way) {
        Border border = in_space(flat, way);
        for (int side = 0; side < 2; ++side, std::reverse(border.begin(), border.end()))
            for (std::size_t start = 0; start < border.size(); ++start) {
                INFO("plane " << way << ", side " << side << ", start " << start);
                CHECK(flaw_of(border) == "");
                std::rotate(border.begin(), border.begin() + 1, border.end());
            }
    }
}

/// The outline of a set of unit squares that are joined by sides and have no hole: right angles, many corners in
/// line, corners at which the outline touches itself left out.
Border outline_of_squares(std::mt19937& random, std::size_t count) {
    using Square = std::array<int, 2>;
    std::set<Square> squares{{0, 0}};
    const auto has = [&](int x, int y) { return squares.contains({x, y}); };
    const auto is_disc_with = [&](int x, int y) {
        // Round the new square the ones that are there must be one run of sides and corners.
        const std::array<std::array<int, 2>, 8> round{
            {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
        int changes = 0, runs_with_side = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            const bool here = has(x + round[k][0], y + round[k][1]);
            const auto& n = round[(k + 1) % 8];
            if (here != has(x + n[0], y + n[1])) ++changes;
            if (here && k % 2 == 0) ++runs_with_side;
        }
        return changes == 2 && runs_with_side > 0;
    };
    for (std::size_t tries = 0; squares.size() < count && tries < 100 * count; ++tries) {
        auto base = squares.begin();
        std::advance(base, static_cast<std::ptrdiff_t>(random() % squares.size()));
        const std::array<Square, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        const Square step = steps[random() % 4];
        const int x = (*base)[0] + step[0], y = (*base)[1] + step[1];
        if (!has(x, y) && is_disc_with(x, y)) squares.insert({x, y});
    }
    std::map<Square, Square> next; // along the outline, counterclockwise
    for (const auto& [x, y] : squares) {
        if (!has(x, y - 1)) next[{x, y}] = {x + 1, y};
        if (!has(x + 1, y)) next[{x + 1, y}] = {x + 1, y + 1};
        if (!has(x, y + 1)) next[{x + 1, y + 1}] = {x, y + 1};
        if (!has(x - 1, y)) next[{x, y + 1}] = {x, y};
    }
    Border border;
    Square at = next.begin()->first;
    do {
        border.push_back({static_cast<double>(at[0]), static_cast<double>(at[1]), 0});
        at = next.at(at);
    } while (at != next.begin()->first);
    REQUIRE(border.size() == next.size());
    return border;
}

} // namespace

TEST_CASE("faces: an L, a star, a comb and a spiral are covered, whatever their first corner is") {
    check_border({{0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {5, 5, 0}, {5, 10, 0}, {0, 10, 0}});
    check_border({{0, 9, 0},
                  {2, 3, 0},
                  {8, 3, 0},
                  {3, -1, 0},
                  {5, -7, 0},
                  {0, -3, 0},
                  {-5, -7, 0},
                  {-3, -1, 0},
                  {-8, 3, 0},
                  {-2, 3, 0}});
    check_border({{0, 0, 0},
                  {9, 0, 0},
                  {9, 5, 0},
                  {8, 1, 0},
                  {6, 5, 0},
                  {5, 1, 0},
                  {3, 5, 0},
                  {2, 1, 0},
                  {0, 5, 0}});
    check_border({{0, 0, 0},
                  {9, 0, 0},
                  {9, 9, 0},
                  {1, 9, 0},
                  {1, 3, 0},
                  {5, 3, 0},
                  {5, 5, 0},
                  {3, 5, 0},
                  {3, 7, 0},
                  {7, 7, 0},
                  {7, 1, 0},
                  {0, 1, 0}});
    check_border({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}); // a concave quadrilateral
}

TEST_CASE("faces: corners in line with their neighbours stay corners") {
    check_border({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    check_border({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 3, 0}});
}

TEST_CASE("faces: a border that runs to holes and back leaves them out") {
    check_border({{0, 0, 0},
                  {9, 0, 0},
                  {9, 9, 0},
                  {0, 9, 0},
                  {0, 0, 0},
                  {3, 3, 0},
                  {3, 6, 0},
                  {6, 6, 0},
                  {6, 3, 0},
                  {3, 3, 0}});
    check_border({{0, 0, 0},
                  {2, 0, 0},
                  {2, 2, 0},
                  {2, 4, 0},
                  {4, 4, 0},
                  {4, 2, 0},
                  {2, 2, 0},
                  {2, 0, 0},
                  {6, 0, 0},
                  {6, 2, 0},
                  {6, 4, 0},
                  {8, 4, 0},
                  {8, 2, 0},
                  {6, 2, 0},
                  {6, 0, 0},
                  {9, 0, 0},
                  {9, 9, 0},
                  {0, 9, 0}});
}

TEST_CASE("faces: random outlines of squares") {
    std::mt19937 random(5);
    const std::size_t draws = test_support::is_sanitized ? 20 : 200;
    for (std::size_t draw = 0; draw < draws; ++draw) {
        INFO("draw " << draw);
        check_border(outline_of_squares(random, 2 + random() % 24));
    }
}

TEST_CASE("faces: the fan round the first corner is kept where it covers the face") {
    const Border border{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 5, 0}, {0, 3, 0}};
    std::vector<Triangle> triangles;
    CHECK(append_face(border, std::array<std::uint32_t, 5>{0, 1, 2, 3, 4}, triangles) ==
          FaceFlaw::none);
    CHECK(triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE(
    "faces: what crosses itself or is not flat is said, and has as many triangles as before") {
    const std::array<std::uint32_t, 5> five{0, 1, 2, 3, 4};
    const auto judged = [&](const Border& border) {
        std::vector<Triangle> triangles;
        const FaceFlaw flaw = append_face(border, std::span(five).first(border.size()), triangles);
        CHECK(triangles.size() + 2 == border.size());
        return flaw;
    };
    CHECK(judged({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}) == FaceFlaw::crosses);
    CHECK(judged({{0, 9, 0}, {5, -7, 0}, {-8, 3, 0}, {8, 3, 0}, {-5, -7, 0}}) ==
          FaceFlaw::crosses); // a pentagram winds twice round its middle
    CHECK(judged({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 4, 1}, {0, 4, 0}}) == FaceFlaw::bent);
    CHECK(judged({{0, 0, 0}, {4, 0, 1}, {4, 4, 0}, {0, 4, 1}}) == FaceFlaw::none); // a twisted quad
    CHECK(judged({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}) == FaceFlaw::none); // no area
    CHECK(judged({{0, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 0, 0}}) == FaceFlaw::none);
}

} // namespace face_test
