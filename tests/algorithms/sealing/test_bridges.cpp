// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks that gaps between borders are closed: of two surfaces side by side, and of one surface.
// The volumes of the blocks tell; they are known from the shape without the gap.
#include <terrane/algorithms/sealing/sealing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/shapes.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

using namespace terrane;
using namespace test_support;

namespace {

Sealed closed_up(const std::vector<Surface>& surfaces, const SealOptions& options) {
    auto made = seal(surfaces, options);
    REQUIRE(made);
    const auto rounded = round_to_doubles(made->arrangement);
    REQUIRE(rounded);
    CHECK(rounded->report.clean);
    return std::move(made).value();
}

/// Returns the volumes of the blocks, ascending.
std::vector<double> volumes_in(const Arrangement& a) {
    const auto volumes = find_volumes(a);
    REQUIRE(volumes);
    std::vector<double> all(volumes->measures.begin() + 1, volumes->measures.end());
    std::sort(all.begin(), all.end());
    return all;
}
std::vector<double> volumes_closed_by(const std::vector<Surface>& surfaces, double distance) {
    return volumes_in(closed_up(surfaces, {.distance = distance}).arrangement);
}

/// Counts edges inside of the cube from 0 to 8 with a single triangle.
std::size_t free_edges(const Arrangement& a) {
    std::size_t count = 0;
    for (std::size_t e = 0; e < a.state->adjacency.edges.size(); ++e) {
        if (a.state->adjacency.triangles_at[e].size() != 1) continue;
        const auto [v, w] = a.state->adjacency.edges[e];
        const Point3 p = a.state->points.nearest(a.vertices[v]),
                     q = a.state->points.nearest(a.vertices[w]);
        const Point3 m{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
        count += m.x > 0 && m.x < 8 && m.y > 0 && m.y < 8 && m.z > 0 && m.z < 8 ? 1 : 0;
    }
    return count;
}

/// A sheet over the columns x and rows y of nodes at heights z(x, y), without the cells for which
/// `is_gap`(column, row) holds.
template <class Height, class IsGap>
Surface surface_over(const std::vector<double>& x, const std::vector<double>& y, const Height& z,
                     const IsGap& is_gap, std::string name) {
    const auto columns = static_cast<unsigned>(x.size() - 1),
               rows = static_cast<unsigned>(y.size() - 1);
    Surface s = grid(
        columns, rows,
        [&](unsigned i, unsigned j) {
            return Point3{x[i], y[j], z(x[i], y[j])};
        },
        std::move(name), Role::horizon);
    std::vector<Triangle> kept;
    for (unsigned j = 0; j < rows; ++j)
        for (unsigned i = 0; i < columns; ++i)
            for (std::size_t k = 0; k < 2; ++k)
                if (!is_gap(i, j)) kept.push_back(s.triangles[2 * (j * columns + i) + k]);
    s.triangles = kept;
    return s;
}

bool nowhere(unsigned, unsigned) {
    return false;
}

double inclined(double x, double y) {
    return 4 + x / 8 - y / 16;
}

const std::vector<double> nodes{-1, 1, 2.5, 4, 5.5, 7, 9};

/// A wall over a line from z = -1 to z = 9.
Surface wall_over(const std::vector<std::array<double, 2>>& line, std::string name) {
    return grid(
        static_cast<unsigned>(line.size() - 1), 3,
        [&](unsigned i, unsigned j) {
            return Point3{line[i][0], line[i][1], -1 + 10.0 * j / 3};
        },
        std::move(name), Role::fault);
}

} // namespace

TEST_CASE("bridges: two surfaces that end side by side are joined", "[seal]") {
    // The right one is a little higher and steeper, so that no tangent plane meets it.
    const auto higher = [](double x, double y) { return inclined(x, y) + 0.02 + 0.003 * (x - 4); };
    for (const std::vector<double>& rows :
         {nodes, std::vector<double>{-1, 9}, std::vector<double>{-1, 0.7, 1.9, 4.2, 6.4, 7.7, 9}}) {
        const std::vector<Surface> model{
            cube(0, 8), surface_over({-1, 2, 3.9}, nodes, inclined, nowhere, "left"),
            surface_over({4, 6.3, 9}, rows, higher, nowhere, "right")};
        CHECK(volumes_closed_by(model, 0.09) == std::vector<double>{512});
        const Sealed s = closed_up(model, {.distance = 0.15});
        const auto volumes = volumes_in(s.arrangement);
        REQUIRE(volumes.size() == 2);
        // Below the inclined plane are 64 times its height in the middle, 4.25; to that, what the
        // right one lies higher, from x = 4 to 8 without the gap and with all of it.
        const double least = 64 * 4.25 + 8 * (0.02 * 4 + 0.003 * 8);
        CHECK(volumes[1] + volumes[0] == Approx(512));
        CHECK(volumes[0] == Approx(512 - least).margin(8 * 0.1 * 0.021));
        CHECK(free_edges(s.arrangement) == 0);
        CHECK(s.left == 0);
        REQUIRE(s.closed.size() >= 1);
        for (const ClosedGap& gap : s.closed) {
            CHECK(gap.from != gap.to);
            CHECK(gap.width > 0.1);
            CHECK(gap.width < 0.11);
        }
        for (const SealChange& c : s.changes) CHECK(c.kind == SealKind::extended);
    }
}

TEST_CASE("bridges: the order of surfaces, triangles and vertices does not matter", "[seal]") {
    const auto higher = [](double x, double y) { return inclined(x, y) + 0.02 + 0.003 * x; };
    std::vector<Surface> model{
        cube(0, 8), surface_over({-1, 2, 3.9}, nodes, inclined, nowhere, "left"),
        surface_over({4, 6, 9}, {-1, 0.7, 4.2, 6.4, 9}, higher, nowhere, "right")};
    const Sealed first = closed_up(model, {.distance = 0.15});
    const auto changes = [](const Sealed& s) {
        std::vector<std::tuple<std::string, double, Point3, std::size_t>> all;
        for (const SealChange& c : s.changes)
            all.emplace_back(s.surfaces[c.surface].name, c.length, c.place, c.triangles);
        std::sort(all.begin(), all.end());
        return all;
    };
    std::swap(model[0], model[2]);
    for (Surface& s : model) {
        std::reverse(s.triangles.begin(), s.triangles.end());
        std::reverse(s.vertices.begin(), s.vertices.end());
        for (Triangle& t : s.triangles)
            for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(s.vertices.size()) - 1 - v;
    }
    const Sealed second = closed_up(model, {.distance = 0.15});
    CHECK(volumes_in(first.arrangement) == volumes_in(second.arrangement));
    CHECK(first.arrangement.triangles.size() == second.arrangement.triangles.size());
    CHECK(changes(first).size() == 1);
    CHECK((changes(first) == changes(second)));
}

TEST_CASE("bridges: surfaces at a large angle are not in one plane", "[seal]") {
    // One horizon ends 0.1 above another one that ends there, too: as layers end at a boundary.
    const auto low = [](double, double) { return 4.0; };
    const auto high = [](double, double) { return 4.1; };
    const std::vector<Surface> model{cube(0, 8),
                                     surface_over({-1, 2, 5}, nodes, low, nowhere, "low"),
                                     surface_over({-1, 3, 5}, nodes, high, nowhere, "high")};
    const Sealed s = closed_up(model, {.distance = 0.15});
    for (const ClosedGap& gap : s.closed) CHECK(gap.width == Approx(0.1));
    REQUIRE(s.open.size() == 2);
    for (const OpenGap& gap : s.open) {
        CHECK(gap.reason == OpenReason::ends_beside);
        CHECK(gap.width == Approx(0.1));
        CHECK(gap.length == Approx(32));
    }
}

TEST_CASE("bridges: a slit is closed", "[seal]") {
    const std::vector<double> columns{-1, 0.5, 2, 3.5, 5, 7, 9}, rows{-1, 1, 3.95, 4.05, 6, 9};
    const auto slit = [](unsigned i, unsigned j) { return j == 2 && i < 4; };
    const std::vector<Surface> whole{cube(0, 8),
                                     surface_over(columns, rows, inclined, nowhere, "horizon")};
    const std::vector<Surface> model{cube(0, 8),
                                     surface_over(columns, rows, inclined, slit, "horizon")};
    const auto right = volumes_in(arrange(whole).value());
    REQUIRE(right.size() == 2);
    CHECK(volumes_closed_by(model, 0.09) == std::vector<double>{512});
    const Sealed s = closed_up(model, {.distance = 0.11});
    const auto volumes = volumes_in(s.arrangement);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[0] == Approx(right[0]));
    CHECK(volumes[1] == Approx(right[1]));
    CHECK(free_edges(s.arrangement) == 0);
    CHECK(s.left == 0);
    for (const ClosedGap& gap : s.closed) {
        CHECK(gap.from == 1);
        CHECK(gap.to == 1);
        CHECK(gap.width == Approx(0.1).epsilon(0.01));
    }
    // A rule for the pair of the surface with itself alone decides.
    CHECK(
        volumes_in(closed_up(model, {.distance = 0, .rules = {{SurfaceId(1), SurfaceId(1), 0.11}}})
                       .arrangement)
            .size() == 2);
    CHECK(
        volumes_in(closed_up(model, {.distance = 0.11, .rules = {{SurfaceId(1), SurfaceId(1), 0}}})
                       .arrangement)
            .size() == 1);
}

TEST_CASE("bridges: a notch that narrows to a point is closed up to its distance", "[seal]") {
    // Two halves that share vertices from x = 5 on; the gap is 0.2 wide at x = -1.
    const auto width = [](double x) { return x < 5 ? (5 - x) / 30 : 0; };
    const std::vector<double> columns{-1, 1, 3, 5, 7, 9};
    Surface notched{"horizon", Role::horizon, {}, {}};
    for (const int side : {-1, 1}) {
        const Surface half = grid(5, 3, [&](unsigned i, unsigned j) {
            const double x = columns[i], near = 4 + side * width(x) / 2;
            const double y = near + (side * 5.0) * (side > 0 ? j : 3 - j) / 3.0;
            return Point3{x, y, inclined(x, y)};
        });
        const auto first = static_cast<std::uint32_t>(notched.vertices.size());
        notched.vertices.insert(notched.vertices.end(), half.vertices.begin(), half.vertices.end());
        for (const auto& [a, b, c] : half.triangles)
            notched.triangles.push_back({first + a, first + b, first + c});
    }
    const std::vector<Surface> model{cube(0, 8), notched};
    CHECK(volumes_closed_by(model, 0.01) == std::vector<double>{512});
    const Sealed s = closed_up(model, {.distance = 0.25});
    const auto volumes = volumes_in(s.arrangement);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[1] == Approx(64 * 4.25).epsilon(1e-9)); // all in one plane
    CHECK(free_edges(s.arrangement) == 0);
}

TEST_CASE("bridges: a fault that nearly closes on itself encloses a block", "[seal]") {
    const double gap = GENERATE(0.01, 0.1);
    std::vector<std::array<double, 2>> line;
    double area = 0;
    for (int i = 0; i <= 20; ++i) {
        const double angle = gap / 4 + (2 * std::numbers::pi - gap / 2) * i / 20;
        line.push_back({4 + 2 * std::cos(angle), 4 + 2 * std::sin(angle)});
    }
    for (std::size_t i = 0; i < line.size(); ++i) { // the polygon with the gap closed
        const auto &p = line[i], &q = line[(i + 1) % line.size()];
        area += (p[0] * q[1] - q[0] * p[1]) / 2;
    }
    const std::vector<Surface> model{cube(0, 8), wall_over(line, "ring")};
    CHECK(volumes_closed_by(model, gap / 2) == std::vector<double>{512});
    const auto volumes = volumes_closed_by(model, 1.5 * gap);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[0] == Approx(8 * area));
    CHECK(volumes[0] + volumes[1] == Approx(512));
}

TEST_CASE("bridges: a fault that ends short of its own middle is extended to it", "[seal]") {
    const std::vector<Surface> model{
        cube(0, 8), wall_over({{1, 1}, {4, 1}, {6, 1}, {6, 6}, {2, 6}, {2, 1.1}}, "hook")};
    CHECK(volumes_closed_by(model, 0.09) == std::vector<double>{512});
    const Sealed s = closed_up(model, {.distance = 0.11});
    const auto volumes = volumes_in(s.arrangement);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[0] == Approx(4 * 5 * 8));
    REQUIRE_FALSE(s.closed.empty());
    CHECK(s.closed[0].from == 1);
    CHECK(s.closed[0].to == 1);
    CHECK(s.closed[0].width == Approx(0.1));
}

TEST_CASE("bridges: a gap that another surface crosses is closed on both sides of it", "[seal]") {
    const auto higher = [](double x, double y) { return inclined(x, y) + 0.02 + 0.003 * x; };
    const std::vector<Surface> model{
        cube(0, 8), surface_over({-1, 2, 3.9}, nodes, inclined, nowhere, "left"),
        surface_over({4, 6, 9}, nodes, higher, nowhere, "right"),
        quad({-1, 3, -1}, {9, 3, -1}, {9, 3, 9}, {-1, 3, 9}, "across")};
    CHECK(volumes_closed_by(model, 0.09).size() == 2);
    CHECK(volumes_closed_by(model, 0.2).size() == 4);
}

TEST_CASE("bridges: what stays open is listed with the reason", "[seal]") {
    // The fault ends within the fifth of eight edges of the border, behind the middle of it.
    const std::vector<Surface> model{
        surface_over(
            {0, 2, 3.9}, {0, 1, 2, 3, 4, 5, 6, 7, 8}, [](double, double) { return 4.0; }, nowhere,
            "horizon"),
        quad({4, -1, 0}, {4, 4.6, 0}, {4, 4.6, 8}, {4, -1, 8}, "fault")};
    const Sealed s = closed_up(model, {.distance = 0.15});
    REQUIRE(s.changes.size() == 1);
    CHECK(s.changes[0].length == Approx(4));
    CHECK(s.left == 0);
    REQUIRE(s.open.size() == 1);
    CHECK(s.open[0].from == 0);
    CHECK(s.open[0].to == 1);
    CHECK(s.open[0].reason == OpenReason::partly_farther);
    CHECK(name_of(s.open[0].reason) == "partly_farther");
    CHECK(s.open[0].edges == 1);
    CHECK(s.open[0].length == Approx(1));
    CHECK(s.open[0].width == Approx(0.1));
    CHECK(s.open[0].place == Point3{3.9, 4.5, 4});
}

TEST_CASE("bridges: a gap with three sides, at a vertex beside an edge, is closed", "[seal]") {
    // Two halves share the line y = 4 but for one vertex in the middle of an edge of the other.
    Surface horizon{"horizon", Role::horizon, {}, {}};
    horizon.vertices = {{-1, -1, 4},      {9, -1, 4}, {-1, 4, 4}, {9, 4, 4},
                        {4, 4.05, 4.001}, {-1, 9, 4}, {9, 9, 4}};
    horizon.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 4, 5}, {4, 6, 5}, {4, 3, 6}};
    const std::vector<Surface> model{cube(0, 8), horizon};
    CHECK(volumes_closed_by(model, 0.01).size() == 1);
    const Sealed s = closed_up(model, {.distance = 0.06});
    const auto volumes = volumes_in(s.arrangement);
    REQUIRE(volumes.size() == 2);
    CHECK(volumes[0] + volumes[1] == Approx(512));
    CHECK(volumes[0] == Approx(256).margin(0.001 * 64));
    CHECK(free_edges(s.arrangement) == 0);
    CHECK(s.left == 0);
}

TEST_CASE("bridges: rough slits in any direction are closed along their whole length", "[seal]") {
    Random random(11);
    for (int round = 0; round < cases(20); ++round) {
        // A slit along the middle of a rough sheet, with other nodes on its two sides.
        const double turn = random_real(random, 0, 6.28), gap = random_real(random, 0.01, 0.1);
        const auto node = [&](double along, double across) {
            const double x = 4 + along * std::cos(turn) - across * std::sin(turn),
                         y = 4 + along * std::sin(turn) + across * std::cos(turn);
            return Point3{x, y, 4 + 0.2 * std::sin(x) + 0.1 * std::cos(y)};
        };
        std::vector<Surface> model{cube(0, 8)};
        for (const int side : {-1, 1}) {
            const auto columns = static_cast<unsigned>(random_real(random, 6, 14));
            std::vector<double> at{-8};
            for (unsigned i = 1; i < columns; ++i)
                at.push_back(-8 + 16 * (i + random_real(random, -0.3, 0.3)) / columns);
            at.push_back(8);
            model.push_back(grid(
                columns, 3,
                [&](unsigned i, unsigned j) {
                    const double border = side * gap / 2, end = side * 8.0;
                    return node(at[i], border + (end - border) * (side > 0 ? j : 3 - j) / 3.0);
                },
                side > 0 ? "one" : "two", Role::horizon));
        }
        INFO(round << ": turn " << turn << ", gap " << gap);
        CHECK(volumes_closed_by(model, gap / 3).size() == 1);
        // Straight edges leave the curved sheet: by at most 0.2 times the eighth of their length
        // squared, which is 3 at most.
        const Sealed s = closed_up(model, {.distance = gap + 0.25});
        const auto volumes = volumes_in(s.arrangement);
        CHECK(volumes.size() == 2);
        CHECK(volumes.front() + volumes.back() == Approx(512));
        CHECK(free_edges(s.arrangement) == 0);
    }
}

TEST_CASE("bridges: two borders with a fault between them go on to the fault", "[seal]") {
    // The horizon ends on both sides of a fault, 0.2 lower on one; the distance is larger than that.
    const auto height = [](double, double) { return 4.0; };
    const auto lower = [](double, double) { return 3.8; };
    Surface horizon = surface_over({-1, 2, 3.95}, nodes, height, nowhere, "horizon");
    const Surface other = surface_over({4.05, 6, 9}, nodes, lower, nowhere, "horizon");
    const auto first = static_cast<std::uint32_t>(horizon.vertices.size());
    horizon.vertices.insert(horizon.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles)
        horizon.triangles.push_back({first + a, first + b, first + c});
    const std::vector<Surface> model{
        cube(0, 8), quad({4, -1, -1}, {4, 9, -1}, {4, 9, 9}, {4, -1, 9}, "fault"), horizon};
    for (const double distance : {0.06, 0.3})
        CHECK(volumes_closed_by(model, distance) ==
              std::vector<double>{32 * 3.8, 128, 128, 32 * 4.2});
}
