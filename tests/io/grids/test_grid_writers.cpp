// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that grids which are written read back, and what formats can't hold.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <terrane/io/files.hpp>

#include "support/files.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

template <class T>
ErrorCode refusal_of_grid(const Result<T>& result) {
    REQUIRE(!result);
    return result.error().code;
}

/// Values of all sizes, some missing, and one that is a usual number for no value.
Grid random_grid(std::uint32_t nx, std::uint32_t ny, unsigned seed) {
    std::mt19937_64 random(seed);
    Grid grid{"top", 461000.5, 5932000.25, nx, ny, 25.5, 12.5, 0, {}};
    std::normal_distribution<double> normal(0, 1000);
    for (std::uint32_t k = 0; k < nx * ny; ++k)
        grid.values.push_back(random() % 5 == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                : normal(random));
    grid.values[0] = -9999;
    grid.values[nx * ny - 1] = 0.1;
    return grid;
}

void check_equal(const Grid& read, const Grid& g) {
    CHECK(read.nx == g.nx);
    CHECK(read.ny == g.ny);
    CHECK(read.x == g.x);
    CHECK(read.y == g.y);
    CHECK(read.dx == g.dx);
    CHECK(read.dy == g.dy);
    CHECK(read.rotation == g.rotation);
    REQUIRE(read.values.size() == g.values.size());
    for (std::size_t k = 0; k < g.values.size(); ++k)
        CHECK(
            (std::isnan(g.values[k]) ? std::isnan(read.values[k]) : read.values[k] == g.values[k]));
}

} // namespace

TEST_CASE("grids: what is written reads back to the last bit", "[io][grids]") {
    const TemporaryFolder folder;
    for (const std::string name : {"asc", "zmap", "irap", "grd"})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const Grid grid = random_grid(3 + seed, 9 - seed, seed);
            const auto path = folder / ("top." + name);
            INFO(name << " " << seed);
            CHECK(holds_grids(*format_named(name)));
            REQUIRE(message_of(write_grid(grid, path)) == "no error");
            const auto read = read_grid(path);
            REQUIRE(message_of(read) == "no error");
            check_equal(*read, grid);
        }
}

TEST_CASE("grids: rows that run down are written up", "[io][grids]") {
    const TemporaryFolder folder;
    Grid down{"top", 10, 50, 2, 3, 5, -10, 0, {1, 2, 3, 4, 5, 6}};
    const Grid up{"top", 10, 30, 2, 3, 5, 10, 0, {5, 6, 3, 4, 1, 2}};
    for (const std::string name : {"asc", "zmap", "irap", "grd"}) {
        INFO(name);
        REQUIRE(message_of(write_grid(down, folder / ("a." + name))) == "no error");
        check_equal(*read_grid(folder / ("a." + name)), up);
    }
}

TEST_CASE("grids: what a format can't hold is refused", "[io][grids]") {
    Grid grid{"top", 0, 0, 2, 2, 1, 1, 30, {1, 2, 3, 4}};
    for (const auto format : {Format::esri, Format::zmap, Format::surfer})
        CHECK(refusal_of_grid(format_grid(grid, format)) == ErrorCode::unsupported);
    for (const auto format : {Format::irap, Format::vti}) CHECK(format_grid(grid, format));
    for (const auto format : {Format::cps3, Format::obj})
        CHECK(refusal_of_grid(format_grid(grid, format)) == ErrorCode::unsupported);
    grid.rotation = 0;
    grid.values[1] = 9999900;
    CHECK(refusal_of_grid(format_grid(grid, Format::irap)) == ErrorCode::bad_number);
    grid.values[1] = -2e38;
    CHECK(refusal_of_grid(format_grid(grid, Format::surfer)) == ErrorCode::bad_number);
    CHECK(format_grid(grid, Format::esri));
    grid.values.pop_back();
    CHECK(refusal_of_grid(format_grid(grid, Format::esri)) == ErrorCode::bad_option);
    const TemporaryFolder folder;
    CHECK(refusal_of_grid(write_grid(grid, folder / "a.xyz")) == ErrorCode::unsupported);
}
