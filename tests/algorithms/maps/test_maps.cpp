// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests maps against planes and a sphere in closed form, and against the grid that a surface was made of.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include <terrane/algorithms/maps/maps.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/io/grids/grid.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

template <class T>
ErrorCode refusal_of_map(const Result<T>& result) {
    REQUIRE(!result);
    return result.error().code;
}

/// A rectangle in the plane z = z0 + a x + b y.
Surface plane(double z0, double a, double b) {
    Surface s{"plane", Role::horizon, {}, {{0, 1, 2}, {0, 2, 3}}};
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}})
        s.vertices.push_back({x, y, z0 + a * x + b * y});
    return s;
}

SurfaceMap mapped(const Surface& of, MapKind kind, double step, std::vector<Surface> to = {}) {
    const std::vector<Surface> surfaces{of};
    const auto grid = grid_over(surfaces, step);
    REQUIRE(message_of(grid) == "no error");
    const auto map = map_surface(surfaces, kind, *grid, to);
    REQUIRE(message_of(map) == "no error");
    return *map;
}

} // namespace

TEST_CASE("maps: planes", "[maps]") {
    const auto height = mapped(plane(5, 0.5, -0.25), MapKind::height, 10);
    CHECK(height.grid.nx == 11); // with the nodes on the border
    CHECK(height.grid.ny == 11);
    CHECK(height.nodes == 121);
    CHECK(height.sheets == 0);
    for (std::size_t k = 0; k < 121; ++k) {
        const double x = 10.0 * double(k % 11), y = 10.0 * double(k / 11);
        CHECK(height.grid.values[k] == Approx(5 + 0.5 * x - 0.25 * y).margin(1e-12));
    }
    const auto depth = mapped(plane(5, 0.5, -0.25), MapKind::depth, 10);
    CHECK(depth.grid.values[7] == -height.grid.values[7]);
    struct Dip {
        double a, b, azimuth;
    };
    for (const auto& [a, b, azimuth] : {Dip{0, -1, 0}, {-1, 0, 90}, {0, 1, 180}, {1, 0, 270}}) {
        CHECK(mapped(plane(0, a, b), MapKind::dip, 25).grid.values[6] == Approx(45));
        CHECK(mapped(plane(0, a, b), MapKind::azimuth, 25).grid.values[6] ==
              Approx(azimuth).margin(1e-12));
    }
    CHECK(mapped(plane(0, 0, 0), MapKind::azimuth, 25).nodes == 0);
    // Parallel planes of dip d are apart by t cos d.
    const auto base = plane(-12, 0.75, 0);
    const auto thick = mapped(plane(0, 0.75, 0), MapKind::thickness, 50, {base});
    const auto apart = mapped(plane(0, 0.75, 0), MapKind::distance, 50, {base});
    for (const double value : thick.grid.values) CHECK(value == Approx(12));
    CHECK(apart.grid.values[4] == Approx(12 * 0.8)); // in the middle
}

TEST_CASE("maps: the nodes of a grid have its heights, to the last bit", "[maps]") {
    std::mt19937 random(3);
    for (const double rotation : {0.0, 90.0, 33.0}) {
        Grid grid{"top", 461000.1, 5932000.7, 17, 12, 25.3, 12.1, rotation, {}};
        for (std::size_t k = 0; k < 17 * 12; ++k)
            grid.values.push_back(double(random() % 100000) / 7);
        const auto surface = surface_of_grid(grid);
        REQUIRE(surface);
        const std::vector<Surface> surfaces{*surface};
        const auto map = map_surface(surfaces, MapKind::height, grid);
        REQUIRE(map);
        CHECK(map->grid.values == grid.values);
        CHECK(map->sheets == 0);
    }
}

TEST_CASE("maps: the highest of several sheets counts, and each node is counted", "[maps]") {
    Surface two = plane(0, 0, 0);
    for (const Point3& p : plane(7, 0, 0).vertices) two.vertices.push_back({p.x / 2, p.y, p.z});
    two.triangles.push_back({4, 5, 6});
    two.triangles.push_back({4, 6, 7});
    const auto map = mapped(two, MapKind::height, 20);
    std::size_t high = 0;
    for (std::size_t k = 0; k < map.grid.values.size(); ++k) {
        const bool is_high = 20 * (k % 6) <= 50;
        high += is_high ? 1 : 0;
        CHECK(map.grid.values[k] == (is_high ? 7 : 0));
    }
    CHECK(high == 18);
    CHECK(map.sheets == 18); // with those on borders
    CHECK(mapped(plane(9, 0, 0), MapKind::thickness, 20, {two}).sheets == 18);
    CHECK(mapped(plane(9, 0, 0), MapKind::distance, 20, {two}).sheets == 0);
}

TEST_CASE("maps: thickness within a box", "[maps]") {
    const auto box = box_boundary({0, 0, 0}, {10, 10, 3});
    REQUIRE(box);
    Mesh mesh;
    for (std::uint32_t s = 0; s < box->size(); ++s) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        const Surface& surface = (*box)[s];
        mesh.vertices.insert(mesh.vertices.end(), surface.vertices.begin(), surface.vertices.end());
        for (const auto& [i, j, k] : surface.triangles)
            mesh.triangles.push_back({first + i, first + j, first + k});
    }
    Volumes volumes;
    volumes.measures.push_back(300);
    for (const auto& [i, j, k] : mesh.triangles) { // the box is convex: its middle tells the sides
        const Point3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const double nx = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y),
                     ny = (b.z - a.z) * (c.x - a.x) - (b.x - a.x) * (c.z - a.z),
                     nz = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const bool inward = nx * (5 - a.x) + ny * (5 - a.y) + nz * (1.5 - a.z) > 0;
        volumes.of_sides.push_back({inward ? 1U : 0U, inward ? 0U : 1U});
    }
    const Grid grid{"", -4, -4, 9, 9, 2, 2, 0, {}};
    const std::vector<BlockId> inside{BlockId(1)}, none{BlockId(2)};
    const auto map = map_blocks(mesh, volumes, inside, grid);
    const auto empty = map_blocks(mesh, volumes, {}, grid);
    REQUIRE(map);
    REQUIRE(empty);
    CHECK(empty->values == std::vector<double>(81));
    double sum = 0;
    for (const double value : map->values) sum += value;
    CHECK(sum == 36 * 3); // 0, 2, .. 10: with the border, on all sides
    CHECK(refusal_of_map(map_blocks(mesh, volumes, none, grid)) == ErrorCode::bad_option);
}

TEST_CASE("maps: what makes no sense is refused", "[maps]") {
    const std::vector<Surface> one{plane(0, 0, 0)};
    const Grid grid = *grid_over(one, 10);
    CHECK(refusal_of_map(map_surface(one, MapKind::thickness, grid)) == ErrorCode::bad_option);
    CHECK(refusal_of_map(map_surface(one, MapKind::height, grid, one)) == ErrorCode::bad_option);
    CHECK(refusal_of_map(map_surface(one, MapKind::height, Grid{})) == ErrorCode::bad_option);
    for (const double step : {0.0, -1.0, std::nan(""), 1e-7})
        CHECK(refusal_of_map(grid_over(one, step)) == ErrorCode::bad_option);
    CHECK(refusal_of_map(grid_over({}, 1)) == ErrorCode::nothing_to_do);
    for (const MapKind kind : {MapKind::height, MapKind::distance})
        CHECK(map_kind_named(name_of(kind)) == kind);
    CHECK(!map_kind_named("heights"));
}
