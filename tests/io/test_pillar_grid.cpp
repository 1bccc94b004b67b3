// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Corner-point grids of horizons: written, read back by the reader of corner-point grids, and compared with planes in
// closed form, with and without a vertical fault.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include <terrane/io/grids/grdecl.hpp>
#include <terrane/io/grids/pillar_grid.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// A rectangle in the plane z = z0 + a x + b y.
Surface tilted_sheet(const std::string& name, std::array<double, 4> box, double z0, double a,
                     double b) {
    Surface s{name, Role::horizon, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const auto& [x, y] :
         {std::pair{box[0], box[1]}, {box[2], box[1]}, {box[2], box[3]}, {box[0], box[3]}})
        s.vertices.push_back({x, y, z0 + a * x + b * y});
    return s;
}

Surface joined(Surface a, const Surface& b) {
    const auto first = std::uint32_t(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [i, j, k] : b.triangles)
        a.triangles.push_back({first + i, first + j, first + k});
    return a;
}

PillarGrid pillars_of(const std::vector<Surface>& horizons, const PillarOptions& options) {
    auto made = make_pillar_grid(horizons, options);
    REQUIRE(message_of(made) == "no error");
    return std::move(*made);
}

/// Returns the grid as it is read back.
CornerPointGrid read_back(const PillarGrid& made, const std::vector<Surface>& horizons) {
    const auto read = read_corner_points(to_grdecl(made, horizons), "made.grdecl");
    REQUIRE(message_of(read) == "no error");
    CHECK(read->depths == made.grid.depths);
    CHECK(read->pillars == made.grid.pillars);
    CHECK(read->active == made.grid.active);
    return *read;
}

/// Returns the depth of a cell (i, j, k) at its corner c = a + 2 b, at its top or its base.
double depth(const CornerPointGrid& grid, const std::array<std::size_t, 3>& cell, std::size_t c,
             bool base) {
    const auto [i, j, k] = cell;
    return grid.depths[((2 * k + (base ? 1 : 0)) * 2 * grid.ny + 2 * j + c / 2) * 2 * grid.nx +
                       2 * i + c % 2];
}

} // namespace

TEST_CASE("pillars: planes are met at each corner of each cell", "[pillars]") {
    const std::array<double, 4> box{-100, -100, 500, 500};
    const std::vector<Surface> horizons{tilted_sheet("a", box, -900, 0.5, 0),
                                        tilted_sheet("b", box, -1000, 0.5, 0.25),
                                        tilted_sheet("c", box, -1500, 0, 0)};
    const PillarOptions options{{0, 100, 250, 400}, {0, 40, 80}, {2, 4}};
    const auto made = pillars_of(horizons, options);
    CHECK(made.gaps.empty());
    CHECK(made.active == 3 * 2 * 6);
    CHECK(made.units == std::vector<std::uint32_t>{1, 1, 2, 2, 2, 2});
    const auto grid = read_back(made, horizons);
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t j = 0; j < 2; ++j)
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t c = 0; c < 4; ++c)
                    for (const bool base : {false, true}) {
                        const double x = options.x[i + c % 2], y = options.y[j + c / 2];
                        const double b = -1000 + 0.5 * x + 0.25 * y, a = -900 + 0.5 * x;
                        const double n = double(k) + (base ? 1 : 0);
                        const double z =
                            k < 2 ? a + (b - a) * n / 2 : b + (-1500 - b) * (n - 2) / 4;
                        CHECK(-depth(grid, {i, j, k}, c, base) == Approx(z).epsilon(1e-15));
                    }
    const auto surfaces = surfaces_of_corner_points(grid);
    REQUIRE(surfaces);
    for (const Surface& s : *surfaces) CHECK(s.role != Role::fault);
}

TEST_CASE("pillars: a vertical fault splits the nodes of its pillars", "[pillars]") {
    const auto faulted = [](const std::string& name, double z) {
        return joined(tilted_sheet(name, {0, 0, 200, 400}, z, 0, 0),
                      tilted_sheet(name, {200, 0, 400, 400}, z - 30, 0, 0));
    };
    const std::vector<Surface> horizons{faulted("top", -100), faulted("base", -200)};
    const auto made = pillars_of(horizons, {{0, 100, 200, 300, 400}, {0, 200, 400}, {5}});
    CHECK(made.active == 4 * 2 * 5);
    const auto grid = read_back(made, horizons);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            CHECK(depth(grid, {i, 1, 0}, c, false) == (i < 2 ? 100 : 130));
            CHECK(depth(grid, {i, 1, 4}, c, true) == (i < 2 ? 200 : 230));
        }
    const auto surfaces = surfaces_of_corner_points(grid);
    REQUIRE(surfaces);
    std::size_t faults = 0;
    for (const Surface& s : *surfaces) {
        if (s.role != Role::fault) continue;
        ++faults;
        for (const Point3& p : s.vertices) CHECK(p.x == 200);
    }
    CHECK(faults == 1);
}

TEST_CASE("pillars: what is missing or crosses is not active, and named", "[pillars]") {
    const std::array<double, 4> box{0, 0, 400, 400};
    const std::vector<double> lines{0, 100, 200, 300, 400};
    const auto top = tilted_sheet("top", box, 0, 0, 0);
    const std::vector<Surface> part{top, tilted_sheet("base", {0, 0, 250, 400}, -10, 0, 0)};
    const auto missing = pillars_of(part, {lines, lines, {2}});
    CHECK(missing.active == 2 * 4 * 2);
    CHECK(missing.gaps.size() == 8);
    CHECK(missing.gaps[0].i == 2);
    CHECK(missing.gaps[0].horizon == 1);
    CHECK(!missing.gaps[0].is_crossed);
    read_back(missing, part);
    const std::vector<Surface> crossing{top, tilted_sheet("base", box, -200, 1, 0)};
    const auto crossed = pillars_of(crossing, {lines, lines, {1}});
    CHECK(crossed.active == 2 * 4); // with those that have no thickness at one side
    CHECK(crossed.gaps.size() == 8);
    CHECK(crossed.gaps[0].is_crossed);
    read_back(crossed, crossing);
}

TEST_CASE("pillars: what makes no grid is refused", "[pillars]") {
    const std::array<double, 4> box{0, 0, 4, 4};
    const std::vector<Surface> two{tilted_sheet("a", box, 0, 0, 0),
                                   tilted_sheet("b", box, -1, 0, 0)};
    const auto code = [](std::span<const Surface> horizons, const PillarOptions& options) {
        const auto made = make_pillar_grid(horizons, options);
        REQUIRE(!made);
        return made.error().code;
    };
    CHECK(code(std::span(two).first(1), {{0, 1}, {0, 1}, {1}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0}, {0, 1}, {1}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0, 1}, {1, 0}, {1}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0, 1}, {0, std::nan("")}, {1}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0, 1}, {0, 1}, {0}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0, 1}, {0, 1}, {1, 2}}) == ErrorCode::bad_option);
    CHECK(code(two, {{0, 1}, {0, 1}, {100000001}}) == ErrorCode::bad_option);
    CHECK(code(two, {{8, 9}, {8, 9}, {1}}) == ErrorCode::nothing_to_do);
    std::stop_source stop;
    stop.request_stop();
    CHECK(!make_pillar_grid(two, {{0, 1}, {0, 1}, {1}}, {.stop = stop.get_token()}));
}
