// SPDX-License-Identifier: LGPL-3.0-or-later
//
// How far rounding moves surfaces and vertices, and that it keeps its limit.
// tests/oracles/rounded_soups.py measures the same in rational numbers.
#include "support/effort.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"
#include "support/soup_laws.hpp"

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/rounding/detail/decimal_frame.hpp>
#include <terrane/algorithms/rounding/detail/reports.hpp>
#include <terrane/algorithms/rounding/detail/snapped_input.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::rounding::detail;
using namespace test_support;

constexpr double spacing_at_4e6 = 0x1p-31;

/// Returns triangles with corners on a decimal lattice at map coordinates, each a surface.
std::vector<Surface> decimal_soup(std::uint32_t seed, int triangles) {
    std::mt19937 random(seed);
    const auto at = [&](double origin) {
        return (10 * origin + static_cast<double>(random() % 3)) / 10;
    };
    std::vector<Surface> soup;
    for (int t = 0; t < triangles; ++t) {
        std::vector<Point3> corners;
        for (int k = 0; k < 3; ++k) corners.push_back({at(5e5), at(4e6), at(-1000)});
        soup.push_back(surface(std::move(corners), {{0, 1, 2}}));
    }
    return soup;
}

/// Turns surfaces about a corner of their lattice, so that no coordinate is a decimal.
std::vector<Surface> turned(std::vector<Surface> surfaces, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (Surface& surface : surfaces)
        for (Point3& p : surface.vertices) {
            const double x = p.x - 5e5, y = p.y - 4e6, z = p.z + 1000;
            const double u = c * x - s * y, v = s * x + c * y;
            p = {5e5 + u, 4e6 + (c * v - s * z), (s * v + c * z) - 1000};
        }
    return surfaces;
}

/// Two sheets in nearly one plane.
std::vector<Surface> sheets_in_nearly_one_plane(unsigned n) {
    const double h = 0.5 / n;
    const auto lifted = [](double x, double y) {
        return Point3{std::cos(0.4) * x - 0.3 * y + 0.3, y - 0.2, std::sin(0.4) * x + 0.7 * y};
    };
    return {unit_grid(n, n, lifted),
            unit_grid(n, n, [=](double x, double y) { return lifted(x + h, y + h); })};
}

/// Checks that no statement of the report contradicts another.
void check_consistent(const RoundingReport& r) {
    CHECK(r.surface_deviation <= r.max_allowed);
    CHECK(r.deviation >= r.surface_deviation + r.vanished_length);
    std::size_t last = 0;
    for (std::size_t k = 0; k < r.moves.size(); ++k)
        if (r.moves[k] > 0) last = k;
    if (last == 0)
        CHECK(r.max_move == 0);
    else if (last > 1)
        CHECK(std::floor(std::log10(r.max_move)) + 24 == static_cast<double>(last));
}

} // namespace

TEST_CASE("rounding: moves are counted by decade", "[rounding]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double least = std::numeric_limits<double>::denorm_min();
    std::array<std::size_t, 32> expected{};
    std::vector<double> moves{0, least, 9e-23, infinity, 1e300};
    expected[0] = 1;
    expected[1] = 2;
    expected[31] = 2;
    for (int k = 2; k < 32; ++k) {
        const double start = std::stod("1e" + std::to_string(k - 24));
        for (const double m : {start, 3 * start, std::nextafter(start, 0.0)}) moves.push_back(m);
        expected[static_cast<std::size_t>(k)] += 2;
        expected[static_cast<std::size_t>(k - 1)] += 1;
    }
    CHECK(decades_of(moves) == expected);
    std::ranges::reverse(moves);
    CHECK(decades_of(moves) == expected);
    CHECK(decades_of({}) == std::array<std::size_t, 32>{});
}

TEST_CASE("movement: surfaces on a decimal lattice move by a few spacings of the doubles") {
    const auto surfaces = read_data("rounding/utm.obj");
    const auto a = arranged(surfaces);
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    CHECK(r.report.surface_deviation < 10 * spacing_at_4e6);
    CHECK(r.report.max_allowed == 1024 * spacing_at_4e6);
    CHECK(r.report.moved_input_vertices == 0);
    check_consistent(r.report);
    CHECK(soup_laws::rounding_flaw(surfaces, a).empty());
}

TEST_CASE("movement: units that nearly coincide across the axis of small coordinates") {
    const auto surfaces = read_data("regression/024-depths-on-a-finer-grid.obj");
    const auto a = arranged(surfaces);
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    CHECK(r.report.naive_contacts > 0);
    CHECK(r.report.surface_deviation > 2 * spacing_at_4e6); // no repair where they lie will do
    check_consistent(r.report);
    CHECK(soup_laws::rounding_flaw(surfaces, a).empty());
}

TEST_CASE("movement: random soups on a decimal lattice") {
    for (int i = 0; i < cases(20); ++i) {
        INFO(i);
        const auto surfaces = decimal_soup(static_cast<std::uint32_t>(i), 30);
        const auto a = arranged(surfaces);
        const auto r = rounded(a);
        CHECK(r.report.clean);
        CHECK(r.report.surface_deviation < 1000 * spacing_at_4e6);
        check_consistent(r.report);
        CHECK(soup_laws::rounding_flaw(surfaces, a) == "");
    }
}

TEST_CASE("movement: random soups on a lattice that is turned in space") {
    for (int i = 0; i < cases(20); ++i) {
        INFO(i);
        const auto surfaces = turned(decimal_soup(static_cast<std::uint32_t>(i), 30), 0.7 + i);
        const auto a = arranged(surfaces);
        const auto r = rounded(a);
        CHECK(r.report.clean);
        CHECK(r.report.surface_deviation < 20 * spacing_at_4e6);
        check_consistent(r.report);
        CHECK(soup_laws::rounding_flaw(surfaces, a) == "");
    }
}

TEST_CASE("movement: sheets in nearly one plane get one plane, and no part more than exact ones") {
    const auto exact = rounded(arranged({unit_grid(16, 16,
                                                   [](double x, double y) {
                                                       return Point3{x, y, 0};
                                                   }),
                                         unit_grid(16, 16, [](double x, double y) {
                                             return Point3{x + 1. / 32, y + 1. / 32, 0};
                                         })}));
    const auto a = arranged(sheets_in_nearly_one_plane(16));
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    CHECK(r.mesh->triangles.size() == exact.mesh->triangles.size());
    CHECK(r.report.moved_input_vertices == 0);
    CHECK(r.report.surface_deviation < 100 * default_max_move(a) / 1024);
}

TEST_CASE("movement: the length of a needle that vanished is no move of a surface") {
    const auto a = arranged(read_data("rounding/re1000070.obj"));
    const auto r = rounded(a);
    REQUIRE(r.report.clean);
    CHECK(r.report.surface_deviation < 1e-14);
    CHECK(r.report.vanished_length > 1);
    check_consistent(r.report);
}

TEST_CASE("movement: a limit that allows to move surfaces onto nothing is refused") {
    // 19 triangles in thirds near 2^48, where doubles are a thirty-second apart.
    const auto a = arranged(read_data("rounding/needles_at_2_48.obj"));
    CHECK_FALSE(rounded(a, {.max_move = 1}).mesh->triangles.empty());
    const auto none = round_to_doubles(a, {.max_move = 1e30});
    REQUIRE_FALSE(none);
    CHECK(none.error().code == ErrorCode::nothing_to_do);
}

TEST_CASE("movement: the limit is kept, and what it leaves is named") {
    const auto a = arranged(sheets_in_nearly_one_plane(16));
    const auto free = rounded(a);
    REQUIRE(free.report.clean);
    CHECK(free.report.surface_deviation <= default_max_move(a));
    check_consistent(free.report);
    const double unit = default_max_move(a) / 1024;
    bool refused_any = false;
    for (const double units : {3., 20., 100., 1e5}) {
        const auto r = rounded(a, {.max_move = units * unit});
        CHECK(r.report.max_allowed == units * unit);
        CHECK(r.report.clean == r.report.contacts.empty());
        CHECK(r.report.clean == verify_conforming(r.mesh->vertices, r.mesh->triangles).empty());
        refused_any = refused_any || !r.report.clean;
        check_consistent(r.report);
    }
    CHECK(refused_any);
    const auto none = round_to_doubles(a, {.max_move = unit / 1e6});
    REQUIRE_FALSE(none);
    CHECK(none.error().code == ErrorCode::bad_option);
    CHECK(none.error().place == "max_move");
}

TEST_CASE("movement: the default limit is 1024 spacings at the largest coordinate of a triangle") {
    Surface s = surface({{-5, 0, 0}, {1, 0, 0}, {0, 3, 0}}, {{0, 1, 2}});
    const auto limit = [&] { return default_max_move(arrange(std::span(&s, 1)).value()); };
    CHECK(limit() == 1024 * 0x1p-50); // doubles between 4 and 8 are 2^-50 apart
    // A vertex without a triangle does not count.
    s.vertices.push_back({0, 1e6, 0});
    CHECK(limit() == 1024 * 0x1p-50);
    s.vertices[1].z = -9;
    CHECK(limit() == 1024 * 0x1p-49);
}

TEST_CASE("movement: no point leaves a box by one unit, and its sides stay planes") {
    const Point3 low{500000.03, 4000000.03, -999.97}, high{500000.17, 4000000.17, -999.83};
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        INFO(seed);
        // Those that are turned a little are no decimals, and are snapped to grids.
        auto surfaces = decimal_soup(seed, 25);
        if (seed % 2 == 1)
            for (Surface& s : surfaces)
                for (Point3& p : s.vertices) p.x += 0.01 * (p.y - 4e6) + 0.003 * (p.z + 1000);
        const auto made = arrange_within(surfaces, box_boundary(low, high).value());
        REQUIRE(made);
        const auto& vertices = made->rounded.mesh->vertices;
        CHECK(std::ranges::all_of(vertices, [&](const Point3& p) {
            return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
                   p.z <= high.z;
        }));
        for (const Point3& corner : {low, high})
            CHECK(std::ranges::find(vertices, corner) != vertices.end());
        check_consistent(made->rounded.report);
    }
}

TEST_CASE("movement: grids contain the planes that are kept") {
    const std::vector<Point3> points{{1, 1, 1}};
    const KeptPlanes kept{std::vector<double>{0.3, 0.7}, {}, {}};
    const auto grid = grid_of_digits(points, 51, 10, kept); // a spacing of 0.5
    REQUIRE(grid);
    CHECK(grid->snap({0.3, 0.3, 0.3}) == Point3{0.3, 0.5, 0.5});
    CHECK(grid->snap({0.2, 0.2, 0.2}) == Point3{0, 0, 0});
    CHECK(grid->snap({0.29, 0, 0}).x == 0.3); // not 0.5, behind the plane
    CHECK(grid->snap({0.8, 0, 0}).x == 1);
    CHECK(grid->snap({0.71, 0, 0}).x == 0.7);
    CHECK(grid->reach() >= 0.25 * std::sqrt(3));
    const auto finer = grid_of_digits(points, 51, 0.3, kept);
    REQUIRE(finer);
    CHECK(finer->step[0] == 0.25);
    CHECK_FALSE(grid_of_digits(points, 51, 1e-17, kept));
}

TEST_CASE("decimal frame: goes back to what was given, in order") {
    const std::vector<Point3> points{{500000.1, 4000000.25, -999.7},
                                     {500000.2, 4000000.5, 3},
                                     {500000.3, std::nextafter(4000000.75, 0), 0},
                                     {500000.123456, 4000001, -1e-3}};
    const std::vector<bool> chosen{true, true, true, false};
    const auto frame = DecimalFrame::of(points, chosen, {});
    REQUIRE(frame);
    CHECK(frame->into(points[0]) == Point3{5000001, 400000025, -9997});
    CHECK(frame->into(points[1]) == Point3{5000002, 400000050, 30});
    CHECK(frame->into(points[2]) == Point3{5000003, 400000075, 0});
    for (const Point3& p : points) CHECK(frame->back(frame->into(p)) == p);
    CHECK(frame->largest_error() < 3 * spacing_at_4e6);
    std::mt19937 random(1);
    std::vector<double> places{5000001, 5000001.23456};
    for (int k = 0; k < 1000; ++k)
        places.push_back(5000000.9 + 1e-9 * static_cast<double>(random() % 4000000000));
    std::ranges::sort(places);
    double last = 0;
    for (const double x : places) {
        const double back = frame->back({x, 0, 0}).x;
        CHECK(last <= back);
        last = back;
    }
}

TEST_CASE("decimal frame: there is none for integers, nor for what is no decimal") {
    const std::vector<bool> chosen(2, true);
    CHECK_FALSE(DecimalFrame::of(std::vector<Point3>{{1, 2, 3}, {4, 5, -6}}, chosen, {}));
    const double third = 1.0 / 3;
    CHECK_FALSE(DecimalFrame::of(std::vector<Point3>{{third, third, third}, {2 * third, 0, 1}},
                                 chosen, {}));
    CHECK(DecimalFrame::of(std::vector<Point3>{{third, third, third}, {2 * third, 0.1, 0.1}},
                           std::vector<bool>{false, true}, {}));
}

TEST_CASE("decimal frame: of coordinates that become the same, the kept one is where they go") {
    const double at = 4000000.1, below = std::nextafter(at, 0);
    const std::vector<Point3> points{{below, 0, 0}, {at, 0, 0}};
    const std::vector<bool> chosen(2, true);
    CHECK(DecimalFrame::of(points, chosen, {})->back({40000001, 0, 0}).x == below);
    const KeptPlanes kept{std::vector<double>{at}, {}, {}};
    CHECK(DecimalFrame::of(points, chosen, kept)->back({40000001, 0, 0}).x == at);
}
