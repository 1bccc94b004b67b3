// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks in the cells of grids: closed forms, and random models, most of them degenerate, against tetrahedra and
// winding numbers in rationals.
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/sections/sections.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include "cells_by_tetrahedra.hpp"
#include "support/effort.hpp"
#include "support/random_models.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

struct CellModel {
    Mesh mesh;
    Volumes volumes;
};

std::optional<CellModel> cell_model(std::vector<Surface> surfaces, std::vector<Surface> boundary) {
    const auto made = arrange_within(std::move(surfaces), std::move(boundary));
    REQUIRE(message_of(made) == "no error");
    if (!made->rounded.report.clean) return std::nullopt;
    CellModel model{*made->rounded.mesh, {}};
    model.volumes = *find_volumes(model.mesh);
    return model;
}

BlocksInCells cells_of(const CellModel& model, const RectilinearGrid& grid, const Run& run = {}) {
    auto found = blocks_in_cells(model.mesh, model.volumes, grid, run);
    REQUIRE(message_of(found) == "no error");
    return std::move(*found);
}

/// A box of planes z = a x + b y + c within a box of the given half width.
CellModel tilted(double a, double b, double c, double half) {
    Surface plane{"plane", Role::horizon, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const auto& [x, y] : {std::pair{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}})
        plane.vertices.push_back({x * half, y * half, (a * x + b * y + c) * half});
    return *cell_model({plane}, *box_boundary({-half, -half, -half}, {half, half, half}));
}

/// The model in which a point lies, by winding numbers; nothing if the rays decide nothing.
std::optional<std::uint32_t> block_by_winding(const CellModel& model, const Point3& p) {
    std::uint32_t found = 0;
    for (std::uint32_t b = 1; b < model.volumes.measures.size(); ++b) {
        std::vector<Triangle> boundary;
        for (std::size_t t = 0; t < model.mesh.triangles.size(); ++t) {
            const auto [i, j, k] = model.mesh.triangles[t];
            const auto [front, behind] = model.volumes.of_sides[t];
            if (front == behind) continue;
            if (front == b) boundary.push_back({i, k, j});
            if (behind == b) boundary.push_back({i, j, k});
        }
        const auto winding = winding_around(model.mesh.vertices, boundary,
                                            {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)});
        if (!winding) return std::nullopt;
        if (*winding != 0) found = b;
    }
    return found;
}

double nearest_to(const mpq_class& q) {
    const double d = q.get_d(); // toward 0
    const double next = std::nextafter(d, HUGE_VAL);
    return mpq_class(q - mpq_class(d)) * 2 > mpq_class(next) - mpq_class(d) ? next : d;
}

/// Compares each fraction with the oracle's, and counts those that are neither 0 nor 1.
std::size_t compare(const CellModel& model, const RectilinearGrid& grid,
                    const BlocksInCells& found) {
    std::size_t partial = 0;
    REQUIRE(found.block_of.size() == grid.size());
    REQUIRE(found.first.size() == grid.size() + 1);
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
        const auto expected = fractions_by_tetrahedra(model.mesh, model.volumes, grid, cell);
        std::size_t shares = 0;
        for (std::uint32_t b = 0; b < expected.size(); ++b) {
            CHECK(found.fraction(cell, BlockId(b)) == nearest_to(expected[b]));
            shares += expected[b] != 0 ? 1 : 0;
            partial += expected[b] != 0 && expected[b] != 1 ? 1 : 0;
        }
        CHECK(found.first[cell + 1] - found.first[cell] == shares);
        if (const auto block = block_by_winding(model, grid.centre(cell)))
            CHECK(found.block_of[cell] == *block);
    }
    return partial;
}

bool same(const BlocksInCells& a, const BlocksInCells& b) {
    const auto equal = [](const BlockShare& x, const BlockShare& y) {
        return x.block == y.block && x.fraction == y.fraction;
    };
    return a.block_of == b.block_of && a.first == b.first && a.fractions == b.fractions &&
           std::equal(a.shares.begin(), a.shares.end(), b.shares.begin(), b.shares.end(), equal);
}

std::vector<double> planes_of(ModelMaker& maker, int most) {
    std::vector<double> planes;
    for (int n = random_int(maker.random, 2, 4); n > 0; --n) planes.push_back(maker.number(most));
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    if (planes.size() == 1) planes.push_back(planes[0] + 1);
    return planes;
}

} // namespace

TEST_CASE("cells: a tilted plane in closed form", "[cells]") {
    const auto model = tilted(0.5, 0, 0, 4);
    const auto grid = cells_by_count(model.mesh, {2, 2, 2});
    REQUIRE(grid);
    CHECK(grid->x == std::vector<double>{-4, 0, 4});
    const auto found = cells_of(model, *grid);
    // z = x / 2: above it in the upper cells at x < 0 all, at x > 0 three quarters
    const std::uint32_t low = found.block_of[0], high = found.block_of[4];
    REQUIRE(low != high);
    for (std::size_t y = 0; y < 2; ++y) {
        CHECK(found.fraction(2 * y, BlockId(low)) == 0.75);
        CHECK(found.fraction(2 * y, BlockId(high)) == 0.25);
        CHECK(found.fraction(2 * y + 1, BlockId(low)) == 1);
        CHECK(found.fraction(2 * y + 4, BlockId(high)) == 1);
        CHECK(found.fraction(2 * y + 5, BlockId(high)) == 0.75);
    }
    CHECK(found.fractions == std::vector<double>{0, 0.5, 0.5});
}

TEST_CASE("cells: surfaces in planes and corners of cells", "[cells]") {
    const auto model = tilted(0, 0, 0, 4);
    for (const std::uint32_t n : {1U, 2U, 3U, 4U, 7U}) {
        const auto grid = cells_by_count(model.mesh, {n, n, n});
        const auto found = cells_of(model, *grid);
        CHECK(compare(model, *grid, found) == (n % 2 == 0 ? 0 : 2 * n * n));
    }
    const auto diagonal = tilted(1, 0, 0, 4); // through edges of cells
    const auto grid = cells_by_count(diagonal.mesh, {4, 4, 4});
    CHECK(compare(diagonal, *grid, cells_of(diagonal, *grid)) == 2 * 16);
}

TEST_CASE("cells: random models against tetrahedra in rationals", "[cells]") {
    std::size_t partial = 0;
    for (int seed = 0; seed < cases(48); ++seed) {
        INFO("seed " << seed);
        ModelMaker maker(0x63656C6Cu + std::uint64_t(seed));
        const auto model =
            cell_model(maker.model(), seed % 2 == 0 ? *box_boundary({-5, -5, -5}, {5, 5, 5})
                                                    : std::vector<Surface>{});
        if (!model) continue;
        RectilinearGrid grid;
        grid.x = planes_of(maker, 6);
        grid.y = planes_of(maker, 6);
        grid.z = planes_of(maker, 6);
        partial += compare(*model, grid, cells_of(*model, grid));
    }
    CHECK(partial > std::size_t(cases(48)));
}

TEST_CASE("cells: the threads change no byte", "[cells]") {
    ModelMaker maker(7);
    const auto model = cell_model(maker.model(), *box_boundary({-5, -5, -5}, {5, 5, 5}));
    REQUIRE(model);
    const auto grid = cells_by_count(model->mesh, {13, 11, 17});
    CHECK(same(cells_of(*model, *grid), cells_of(*model, *grid, {.threads = 3})));
}

TEST_CASE("cells: far, tiny and huge coordinates", "[cells]") {
    for (const double scale : {1e-90, 1e-30, 1.0, 1e30, 1e90}) {
        INFO(scale);
        const auto model = tilted(0.3, 0.2, 0.1, scale);
        const auto grid = cells_by_count(model.mesh, {3, 2, 3});
        CHECK(compare(model, *grid, cells_of(model, *grid)) > 10);
    }
    std::mt19937 random(5);
    Surface hills{"hills", Role::horizon, {}, {}};
    constexpr std::uint32_t n = 8;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            hills.vertices.push_back(
                {461000.1 + 25.3 * i, 5932000.7 + 12.1 * j, -2000 + double(random() % 1000) / 7});
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + n + 1;
            hills.triangles.push_back({a, a + 1, b + 1});
            hills.triangles.push_back({a, b + 1, b});
        }
    const auto model =
        cell_model({hills}, *box_boundary({461010, 5932005, -2200}, {461190, 5932090, -1800}));
    REQUIRE(model);
    const auto grid = cells_with_steps(model->mesh, {50, 40, 100});
    REQUIRE(grid);
    CHECK(grid->x == std::vector<double>{461000, 461050, 461100, 461150, 461200});
    CHECK(compare(*model, *grid, cells_of(*model, *grid)) > 20);
}

TEST_CASE("cells: a sliver has its share, to the last bit", "[cells]") {
    for (const double thickness : {0x1p-20, 0x1p-50, 0x1p-52}) {
        std::vector<Surface> boundary = *box_boundary({0, 0, 0}, {1, 1, 1});
        Surface lid{"lid", Role::horizon, {}, {{0, 1, 2}, {0, 2, 3}}};
        lid.vertices = {{-1, -1, 1 - 2 * thickness},
                        {2, -1, 1 - thickness},
                        {2, 2, 1 - thickness},
                        {-1, 2, 1 - 2 * thickness}};
        const auto model = cell_model({lid}, boundary);
        REQUIRE(model);
        const RectilinearGrid grid{{-0.25, 0.5, 1}, {0.125, 1.5}, {0, 0.5, 1}};
        CHECK(compare(*model, grid, cells_of(*model, grid)) > 3);
    }
}

TEST_CASE("cells: what makes no grid is refused", "[cells]") {
    const auto model = tilted(0, 0, 0, 4);
    const auto code_of = [](const auto& result) {
        REQUIRE(!result);
        return result.error().code;
    };
    for (const double step : {0.0, -1.0, std::nan(""), HUGE_VAL, 1e-4, 1e-300})
        CHECK(code_of(cells_with_steps(model.mesh, {1, step, 1e-3})) == ErrorCode::bad_option);
    CHECK(code_of(cells_by_count(model.mesh, {0, 1, 1})) == ErrorCode::bad_option);
    CHECK(code_of(cells_by_count(model.mesh, {100000, 100000, 1})) == ErrorCode::bad_option);
    CHECK(code_of(cells_by_count({}, {1, 1, 1})) == ErrorCode::nothing_to_do);
    CHECK(code_of(cells_with_steps({}, {1, 1, 1})) == ErrorCode::nothing_to_do);
    for (const std::vector<double>& bad :
         {std::vector<double>{}, {1}, {1, 1}, {2, 1}, {1, HUGE_VAL}, {std::nan(""), 1}})
        CHECK(code_of(blocks_in_cells(model.mesh, model.volumes, {bad, {0, 1}, {0, 1}})) ==
              ErrorCode::bad_option);
    auto wrong = model;
    for (std::size_t t = 0; t < wrong.mesh.triangles.size(); ++t) { // of the plane
        const auto& [i, j, k] = wrong.mesh.triangles[t];
        const auto& v = wrong.mesh.vertices;
        if (v[i].z != 0 || v[j].z != 0 || v[k].z != 0) continue;
        std::swap(wrong.volumes.of_sides[t][0], wrong.volumes.of_sides[t][1]);
        break;
    }
    CHECK(code_of(blocks_in_cells(wrong.mesh, wrong.volumes, {{-5, 5}, {-5, 5}, {-5, 5}})) ==
          ErrorCode::internal);
    std::stop_source stop;
    stop.request_stop();
    CHECK(code_of(blocks_in_cells(model.mesh, model.volumes, {{-5, 5}, {-5, 5}, {-5, 5}},
                                  {.stop = stop.get_token()})) == ErrorCode::interrupted);
}
