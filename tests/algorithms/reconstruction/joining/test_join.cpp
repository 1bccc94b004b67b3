// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks that joined surfaces keep the surface, close the hole and are conforming, by exact check.
#include <terrane/algorithms/reconstruction/joining/join.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stop_token>

#include <catch2/catch.hpp>

#include "support/effort.hpp"
#include "support/loops.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/check/check.hpp>

using namespace terrane;
using namespace test_support;

namespace {

double wavy(double x, double y) {
    return 0.3 * std::sin(x) * std::cos(0.7 * y);
}

/// Returns the hole that find_border_loops lists first.
BorderLoop first_hole(const Surface& s) {
    const auto holes = holes_of(s);
    REQUIRE_FALSE(holes.empty());
    return holes.front();
}

std::size_t hole_count(const Surface& s) {
    const auto loops = find_border_loops(s);
    return static_cast<std::size_t>(
        std::count_if(loops.value().begin(), loops.value().end(),
                      [](const BorderLoop& l) { return l.kind != LoopKind::outer; }));
}

/// Tells whether borders of different parts meet in a vertex, which joining does not support.
bool borders_touch(const Surface& s) {
    const auto loops = find_border_loops(s);
    std::vector<std::uint32_t> vertices;
    for (const BorderLoop& l : loops.value())
        vertices.insert(vertices.end(), l.vertices.begin(), l.vertices.end());
    std::sort(vertices.begin(), vertices.end());
    return std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end();
}

/// Counts the triangles that use each edge from the lower vertex to the higher, and back.
std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> edge_uses(const Surface& s) {
    std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> uses;
    for (const Triangle& t : s.triangles)
        for (unsigned k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            ++uses[{std::min(a, b), std::max(a, b)}][a < b ? 0 : 1];
        }
    return uses;
}

void check_laws(const Surface& before, const BorderLoop& loop, const Surface& filling,
                const Joined& joined) {
    const Surface& after = joined.surface;
    // The vertices and triangles of the surface come first, unchanged.
    REQUIRE(after.triangles.size() > before.triangles.size());
    CHECK(std::equal(before.triangles.begin(), before.triangles.end(), after.triangles.begin()));
    CHECK(std::equal(before.vertices.begin(), before.vertices.end(), after.vertices.begin()));
    CHECK(after.name == before.name);
    CHECK(after.role == before.role);
    // New vertices are those of the filling, bit by bit; each is used.
    REQUIRE(after.vertices.size() == before.vertices.size() + joined.filling_vertices.size());
    for (std::size_t v = 0; v < joined.filling_vertices.size(); ++v)
        CHECK(after.vertices[before.vertices.size() + v] ==
              filling.vertices[joined.filling_vertices[v]]);
    std::vector<bool> used(after.vertices.size(), false);
    for (std::size_t t = before.triangles.size(); t < after.triangles.size(); ++t)
        for (const std::uint32_t v : after.triangles[t]) used[v] = true;
    CHECK(std::all_of(used.begin() + static_cast<std::ptrdiff_t>(before.vertices.size()),
                      used.end(), [](bool b) { return b; }));
    // The border edges are undivided; each has one new triangle, oriented opposite to the old one.
    const auto uses = edge_uses(after);
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
        const std::uint32_t a = loop.vertices[i], b = loop.vertices[(i + 1) % loop.vertices.size()];
        const auto found = uses.find({std::min(a, b), std::max(a, b)});
        REQUIRE(found != uses.end());
        CHECK(found->second == std::array{1, 1});
    }
    CHECK(hole_count(after) + 1 == hole_count(before));
    const auto report = check(std::span(&after, 1));
    REQUIRE(report);
    CHECK(report.value().clean());
    CHECK(report.value().non_manifold_edges.empty());
    CHECK(joined.report.new_vertices == joined.filling_vertices.size());
    CHECK(joined.report.new_triangles == after.triangles.size() - before.triangles.size());
}

Joined join_well(const Surface& s, const Surface& filling, JoinOptions options = {}) {
    const BorderLoop loop = first_hole(s);
    const auto loops = find_border_loops(s);
    options.loops = loops.value();
    auto joined = join_filling(s, loop, filling, options);
    if (!joined) FAIL(joined.error().message());
    check_laws(s, loop, filling, joined.value());
    return std::move(joined).value();
}

double area_of(const Surface& s, std::size_t first) {
    double sum = 0;
    for (std::size_t t = first; t < s.triangles.size(); ++t) {
        const Point3 &a = s.vertices[s.triangles[t][0]], &b = s.vertices[s.triangles[t][1]],
                     &c = s.vertices[s.triangles[t][2]];
        sum += ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)) / 2;
    }
    return sum;
}

/// Computes the smallest angle of the new triangles, in degrees.
double least_angle(const Joined& j, std::size_t first) {
    double least = 180;
    for (std::size_t t = first; t < j.surface.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k) {
            const auto at = [&](unsigned i) {
                return j.surface.vertices[j.surface.triangles[t][(k + i) % 3]];
            };
            const Point3 a = at(0), b = at(1), c = at(2);
            const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
            const double d = (u.x * v.x + u.y * v.y + u.z * v.z) / std::hypot(u.x, u.y, u.z) /
                             std::hypot(v.x, v.y, v.z);
            least = std::min(least, std::acos(std::clamp(d, -1.0, 1.0)) * 180 / std::acos(-1.0));
        }
    return least;
}

} // namespace

TEST_CASE("join: a disk in a wavy sheet is joined with fillings of any mesh size", "[join]") {
    const Surface holed = punched(sheet(graph(wavy), 0, 0, 10, 10, 40, 40, 0.25), disk(5, 5, 2.2));
    const double hole = 100 - area_of(holed, 0);
    for (const unsigned n : {5U, 13U, 33U, 150U}) {
        const Surface filling = sheet(graph(wavy), 1.9, 2.05, 8.1, 8.03, n, n, 0.2, n);
        const Joined joined = join_well(holed, filling);
        CHECK(area_of(joined.surface, holed.triangles.size()) == Approx(hole).epsilon(1e-12));
        INFO(n << ": least angle " << least_angle(joined, holed.triangles.size()));
        if (n == 33) CHECK(least_angle(joined, holed.triangles.size()) > 15);
    }
}

TEST_CASE("join: holes of any shape are joined", "[join]") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> at(3, 7), size(0.15, 1.2);
    for (int i = 0; i < cases(40); ++i) {
        Surface holed = sheet(graph(wavy), 0, 0, 10, 10, 50, 50, i % 3 == 0 ? 0 : 0.24,
                              static_cast<unsigned>(i));
        const int parts = 1 + i % 4; // overlapping disks and bars: concave borders, fjords
        for (int k = 0; k < parts; ++k) {
            const double x = at(random), y = at(random), r = size(random);
            if (k % 2 == 0)
                holed = punched(holed, disk(x, y, r));
            else
                holed = punched(holed, [&](const Point3& p) {
                    return std::fabs(p.x - x) < 2 * r && std::fabs(p.y - y) < 0.15 * r;
                });
        }
        if (borders_touch(holed)) continue;
        const auto n = static_cast<unsigned>(10 + 7 * (i % 10));
        const Surface filling = sheet(graph(wavy), -1, -1, 11, 11, n, n, 0.25, 99);
        while (hole_count(holed) > 0) {
            CAPTURE(i, hole_count(holed));
            holed = join_well(holed, filling).surface;
        }
        CHECK(area_of(holed, 0) == Approx(100).epsilon(1e-12));
    }
}

TEST_CASE("join: four holes of one horizon are joined (the paper's Figure 22)", "[join]") {
    Surface s = sheet(graph(wavy), 0, 0, 20, 20, 80, 80, 0.24);
    for (const auto& hole : {disk(5, 5, 2.5), disk(14, 4, 1.2), disk(6, 14, 3.1)})
        s = punched(s, hole);
    s = punched(s, [](const Point3& p) { // a channel with a bend
        return std::fabs(p.y - 13 - std::sin(p.x)) < 0.7 && p.x > 11 && p.x < 18;
    });
    REQUIRE(hole_count(s) == 4);
    const double before = area_of(s, 0);
    const Surface filling = sheet(graph(wavy), -0.3, -0.3, 20.3, 20.3, 71, 71, 0.2, 3);
    while (hole_count(s) > 0) s = join_well(s, filling).surface;
    CHECK(area_of(s, 0) == Approx(400).epsilon(1e-12));
    CHECK(before < 350);
    CHECK(find_border_loops(s).value().size() == 1);
}

TEST_CASE("join: islands in a hole are joined to the filling", "[join]") {
    const Surface all = sheet(graph(wavy), 0, 0, 10, 10, 50, 50, 0.24);
    const Surface s = punched(all, [](const Point3& p) {
        return disk(5, 5, 3)(p) && !disk(4, 4.5, 0.7)(p) && !disk(6.2, 6, 0.45)(p);
    });
    const Surface filling = sheet(graph(wavy), 1, 1, 9, 9, 43, 43, 0.2, 3);
    const Joined joined = join_well(s, filling);
    CHECK(joined.report.islands == 2);
    CHECK(area_of(joined.surface, 0) == Approx(100).epsilon(1e-12));
    CHECK(find_border_loops(joined.surface).value().size() == 1);
    // Without their loops the filling would cover them, which is detected.
    const auto blind = join_filling(s, first_hole(s), filling);
    REQUIRE(!blind);
    CHECK(blind.error().code == ErrorCode::improper_contact);
}

TEST_CASE("join: a hole in a fold that is no graph is joined", "[join]") {
    // Half a horizontal cylinder, then a flat limb: overhanging.
    const SheetShape fold = [](double u, double v) {
        const double angle = 1.6 * u;
        return Point3{3 * std::sin(angle), v, 3 * (1 - std::cos(angle))};
    };
    Surface s = sheet(fold, -1, -3, 2.2, 3, 60, 36, 0.25);
    s = punched(s, [](const Point3& p) {
        return std::hypot(p.x - 3, p.y, p.z - 3) < 1.4; // where it is vertical
    });
    const Surface filling = sheet(fold, 0.1, -2.2, 1.9, 2.2, 31, 31, 0.2, 5);
    const Joined joined = join_well(s, filling);
    CHECK(joined.report.new_vertices > 100);
    // The same surface rotated and with the opposite orientation is joined as well.
    Surface back = filling;
    for (Triangle& t : back.triangles) std::swap(t[1], t[2]);
    const Joined again = join_well(s, back);
    CHECK(again.surface.triangles == joined.surface.triangles);
    CHECK(again.surface.vertices == joined.surface.vertices);
}

TEST_CASE("join: the result depends on neither threads nor search method", "[join]") {
    const Surface s = punched(sheet(graph(wavy), 0, 0, 10, 10, 30, 30, 0.24), disk(5, 5, 3));
    const Surface filling = sheet(graph(wavy), 1, 1, 9, 9, 37, 37, 0.2, 9);
    const Joined one = join_well(s, filling);
    for (const Search search : {Search::automatic, Search::grid, Search::brute}) {
        const auto other =
            join_filling(s, first_hole(s), filling, {.search = search}, {.threads = 3});
        REQUIRE(other);
        CHECK(other.value().surface.triangles == one.surface.triangles);
        CHECK(other.value().surface.vertices == one.surface.vertices);
    }
}

TEST_CASE("join: the smallest holes are filled without new vertices", "[join]") {
    Surface s = sheet(graph(wavy), 0, 0, 4, 4, 8, 8);
    s.triangles.erase(s.triangles.begin() + 60);
    const Surface filling = sheet(graph(wavy), 0.01, 0.02, 4, 3.9, 50, 50, 0.2);
    const Joined joined = join_well(s, filling, {.clearance = 0.9});
    CHECK(joined.report.new_triangles >= 1);
    const Joined coarse = join_well(s, sheet(graph(wavy), 0.01, 0.02, 4, 3.9, 3, 3));
    CHECK(coarse.report.new_triangles == 1);
    CHECK(coarse.report.new_vertices == 0);
}

TEST_CASE("join: a filling that can't be joined is refused, and the error names the place",
          "[join]") {
    const Surface s = punched(sheet(graph(wavy), 0, 0, 10, 10, 40, 40), disk(5, 5, 2));
    const BorderLoop loop = first_hole(s);
    const auto code = [&](const Surface& filling, const JoinOptions& options = {}) {
        const auto joined = join_filling(s, loop, filling, options);
        REQUIRE(!joined);
        CHECK(!joined.error().message().empty());
        return joined.error().code;
    };
    SECTION("a filling that is too small, too far away, or has a hole itself") {
        CHECK(code(sheet(graph(wavy), 4, 4, 6, 6, 20, 20)) == ErrorCode::not_closed);
        CHECK(code(sheet(graph([](double, double) { return 9.0; }), 0, 0, 10, 10, 20, 20)) ==
              ErrorCode::not_closed);
        CHECK(code(punched(sheet(graph(wavy), 0, 0, 10, 10, 41, 43), disk(5, 5, 1))) ==
              ErrorCode::not_closed);
        CHECK(code(Surface{}) == ErrorCode::not_closed);
    }
    SECTION("a filling that meets itself, or the surface elsewhere") {
        Surface twice = sheet(graph(wavy), 2, 2, 8, 8, 30, 30);
        const auto tilted =
            sheet(graph([](double x, double) { return x - 5; }), 4.5, 4.5, 5.5, 5.5, 3, 3);
        const auto first = static_cast<std::uint32_t>(twice.vertices.size());
        twice.vertices.insert(twice.vertices.end(), tilted.vertices.begin(), tilted.vertices.end());
        for (const Triangle& t : tilted.triangles)
            twice.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        CHECK(code(twice) == ErrorCode::improper_contact);
        Surface with_wall = s; // a wall through the hole
        const auto n = static_cast<std::uint32_t>(with_wall.vertices.size());
        with_wall.vertices.insert(with_wall.vertices.end(), {{4, 5, -2}, {6, 5, -2}, {5, 5, 2}});
        with_wall.triangles.push_back({n, n + 1, n + 2});
        const auto crossing = join_filling(with_wall, loop, sheet(graph(wavy), 1, 1, 9, 9, 30, 30));
        REQUIRE(!crossing);
        CHECK(crossing.error().code == ErrorCode::improper_contact);
        CHECK(!crossing.error().place.empty());
    }
    SECTION("invalid loops and options") {
        const Surface filling = sheet(graph(wavy), 1, 1, 9, 9, 30, 30);
        CHECK(code(filling, {.strip = -1}) == ErrorCode::bad_option);
        CHECK(code(filling, {.clearance = 1}) == ErrorCode::bad_option);
        for (const std::vector<std::uint32_t>& wrong :
             {std::vector<std::uint32_t>{}, {0, 1, 40}, {0, 1, 1U << 30U}}) {
            BorderLoop other = loop;
            other.vertices = wrong;
            CHECK(!join_filling(s, other, filling));
        }
        Surface broken = filling;
        broken.vertices[7].z = std::nan("");
        CHECK(code(broken) == ErrorCode::bad_number);
    }
    SECTION("a request to stop") {
        std::stop_source source;
        source.request_stop();
        Run run;
        run.stop = source.get_token();
        const auto joined = join_filling(s, loop, sheet(graph(wavy), 1, 1, 9, 9, 30, 30), {}, run);
        REQUIRE(!joined);
        CHECK(joined.error().code == ErrorCode::interrupted);
    }
}
