// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the regions of models for which they are known.
#include "support/claim.hpp"
#include "support/effort.hpp"
#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/shapes.hpp"

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace {

using namespace terrane;
using namespace test_support;

/// Returns n x n squares of the horizontal plane z = 0, from 0 to 4.
Surface horizon(unsigned n = 4) {
    return grid(n, n, [n](unsigned i, unsigned j) { return Point3{4.0 * i / n, 4.0 * j / n, 0}; });
}

/// Returns a vertical wall over the line from (x0, y0) to (x1, y1), from z = -1 to 1.
Surface wall(double x0, double y0, double x1, double y1) {
    return surface({{x0, y0, -1}, {x1, y1, -1}, {x1, y1, 1}, {x0, y0, 1}}, {{0, 1, 2}, {0, 2, 3}});
}

void check_same(const Regions& r, const Regions& expected) {
    CHECK(r.regions_of == expected.regions_of);
    REQUIRE(r.regions.size() == expected.regions.size());
    for (std::size_t i = 0; i < r.regions.size(); ++i) {
        CHECK(r.regions[i].area == expected.regions[i].area);
        CHECK(r.regions[i].neighbours == expected.regions[i].neighbours);
    }
}

/// Finds regions from the mesh alone and from the arrangement's adjacency, which must agree.
Regions regions(const std::vector<Surface>& surfaces) {
    const Arrangement a = arranged(surfaces);
    REQUIRE(flaws(surfaces, a) == "");
    std::vector<Point3> vertices;
    for (const PointIndex p : a.vertices) vertices.push_back(a.state->points.nearest(p));
    const Regions found = find_regions(vertices, a.triangles, a.surfaces_of, a.state->adjacency,
                                       a.intersection_edges);
    Mesh mesh{.surfaces = a.surfaces,
              .vertices = vertices,
              .triangles = a.triangles,
              .surfaces_of = a.surfaces_of,
              .regions_of = {},
              .parents_of = a.parents_of,
              .intersection_edges = a.intersection_edges};
    check_same(find_regions(mesh), found);
    mesh.parents_of = {}; // like a mesh from another program
    check_same(find_regions(mesh), found);
    return found;
}

/// Returns the areas of a surface's regions, ascending.
std::vector<double> areas(const Regions& r, std::uint32_t surface) {
    std::vector<double> all;
    for (const Region& region : r.regions)
        if (region.surface == surface) all.push_back(region.area);
    std::sort(all.begin(), all.end());
    return all;
}

void check_areas(const Regions& r, std::uint32_t surface, const std::vector<double>& expected) {
    const auto found = areas(r, surface);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == Approx(expected[i]));
}

/// Checks that regions are sorted by surface, then by lowest triangle, that sizes add up, and that
/// neighbours are mutual.
void check_order(const Regions& r) {
    std::size_t slots = 0;
    for (std::size_t i = 0; i < r.regions.size(); ++i) {
        const Region& region = r.regions[i];
        slots += region.triangles;
        CHECK(std::is_sorted(region.neighbours.begin(), region.neighbours.end()));
        for (const std::uint32_t n : region.neighbours) {
            const auto& back = r.regions[n].neighbours;
            CHECK(n != i);
            CHECK(std::binary_search(back.begin(), back.end(), static_cast<std::uint32_t>(i)));
        }
        if (i == 0) continue;
        const Region& before = r.regions[i - 1];
        CHECK(std::pair{before.surface, before.first_triangle} <
              std::pair{region.surface, region.first_triangle});
    }
    CHECK(slots == r.regions_of.values.size());
}

/// Returns the neighbours of each region by the sentence in the header: those that share an
/// intersection edge with it.
std::vector<std::set<std::uint32_t>> neighbours_by_edges(const Arrangement& a, const Regions& r) {
    std::map<Edge, std::set<std::uint32_t>> at_edge;
    for (std::size_t t = 0; t < a.triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(a.triangles[t][i], a.triangles[t][(i + 1) % 3]);
            at_edge[{low, high}].insert(r.regions_of[t].begin(), r.regions_of[t].end());
        }
    std::vector<std::set<std::uint32_t>> neighbours(r.regions.size());
    for (const Edge& e : a.intersection_edges)
        for (const std::uint32_t q : at_edge.at(e))
            for (const std::uint32_t p : at_edge.at(e))
                if (p != q) neighbours[p].insert(q);
    return neighbours;
}

void check_neighbours(const std::vector<Surface>& surfaces) {
    const Regions r = regions(surfaces);
    check_order(r);
    const auto expected = neighbours_by_edges(arranged(surfaces), r);
    for (std::size_t i = 0; i < r.regions.size(); ++i)
        REQUIRE(std::ranges::equal(r.regions[i].neighbours, expected[i]));
}

} // namespace

TEST_CASE("regions: a sheet alone is one, two sheets apart are two") {
    const Regions one = regions({horizon()});
    CHECK(one.regions.size() == 1);
    check_areas(one, 0, {16});
    CHECK(one.regions[0].triangles == 32);
    CHECK(one.regions[0].neighbours.empty());
    Surface two = horizon(1);
    two.vertices.insert(two.vertices.end(), {{9, 9, 9}, {10, 9, 9}, {9, 10, 9}});
    two.triangles.push_back({4, 5, 6});
    const Regions apart = regions({two});
    check_areas(apart, 0, {0.5, 16});
    check_order(apart);
}

TEST_CASE("regions: a plane cuts a sheet into two") {
    Regions r = regions({horizon(), wall(1.5, 0, 1.5, 4)}); // from border to border of both
    check_order(r);
    check_areas(r, 0, {6, 10});
    check_areas(r, 1, {4, 4});
    REQUIRE(r.regions.size() == 4);
    CHECK(r.regions[0].neighbours == std::vector<std::uint32_t>{1, 2, 3});
    r = regions({horizon(), wall(1.5, -1, 1.5, 5)}); // the curve ends within the wall
    check_areas(r, 0, {6, 10});
    check_areas(r, 1, {12});
    CHECK(r.regions[0].neighbours == std::vector<std::uint32_t>{1, 2});
}

TEST_CASE("regions: two planes cut a sheet into four") {
    const Regions r = regions({horizon(), wall(1.5, -1, 1.5, 5), wall(-1, 0.5, 5, 0.5)});
    check_order(r);
    check_areas(r, 0, {0.75, 1.25, 5.25, 8.75});
    check_areas(r, 1, {3, 9}); // each wall is cut by the other wall; the sheet ends within
    check_areas(r, 2, {5, 7});
}

TEST_CASE("regions: a fault that ends within the sheet leaves it one region") {
    const Regions r = regions({horizon(), wall(1.5, -1, 1.5, 2)});
    check_order(r);
    check_areas(r, 0, {16});
    check_areas(r, 1, {6}); // it dangles beyond the sheet's border: also one region
    const Regions inside = regions({horizon(), wall(1.5, 1, 1.5, 3)});
    check_areas(inside, 0, {16});
    check_areas(inside, 1, {2, 2}); // the curve goes from border to border of the fault
    REQUIRE(inside.regions.size() == 3);
    CHECK(inside.regions[1].neighbours == std::vector<std::uint32_t>{0, 2});
}

TEST_CASE("regions: a closed box that a sheet cuts") {
    Surface box;
    for (int k = 0; k < 8; ++k)
        box.vertices.push_back({1.0 + 2 * (k & 1), 1.0 + (k & 2), (k & 4) / 2 - 1.0});
    box.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    check_areas(regions({box}), 0, {24});
    const Regions r = regions({box, horizon()});
    check_order(r);
    check_areas(r, 0, {12, 12});
    check_areas(r, 1, {4, 12}); // inside and outside of the box
}

TEST_CASE("regions: a coplanar overlap divides both sheets, and belongs to both") {
    Surface shifted = horizon(3);
    for (Point3& p : shifted.vertices) p.x += 3;
    const Regions r = regions({horizon(), shifted});
    check_order(r);
    check_areas(r, 0, {4, 12});
    check_areas(r, 1, {4, 12});
}

TEST_CASE("regions: edges in which a surface meets itself in three divide it") {
    Surface s = horizon(2);
    s.vertices.push_back({2, 0, 3});
    s.triangles.push_back({1, 4, 9}); // stands on the edge from (2, 0) to (2, 2)
    const Regions r = regions({s});
    check_order(r);
    check_areas(r, 0, {3, 16}); // the edge ends inside the sheet
}

TEST_CASE("regions: numbers do not depend on the run") {
    const std::vector<Surface> model{horizon(), wall(1.5, -1, 1.5, 5), wall(-1, 0.5, 5, 0.5)};
    const Regions a = regions(model), b = regions(model);
    CHECK(a.regions_of == b.regions_of);
}

TEST_CASE("regions: neighbours along a line on which many triangles begin and end") {
    Random random(77);
    for (int k = 0; k < cases(20); ++k) {
        Surface s; // triangles with a side on one of three lines that meet
        const int count = random_int(random, 3, 30);
        for (int i = 0; i < count; ++i) {
            const double from = random_int(random, -9, 8),
                         to = random_int(random, int(from) + 1, 9);
            const double y = random_int(random, -3, 3), z = random_int(random, 1, 3);
            const auto on_line = [&, line = random_int(random, 0, 2)](double x) {
                return line == 0 ? Point3{x, 0, 0} : line == 1 ? Point3{0, x, 0} : Point3{x, x, 0};
            };
            const auto first = static_cast<std::uint32_t>(s.vertices.size());
            s.vertices.insert(s.vertices.end(), {on_line(from), on_line(to), {from, y, z}});
            s.triangles.push_back({first, first + 1, first + 2});
        }
        check_neighbours({s});
    }
}

TEST_CASE("regions: neighbours where surfaces coincide") {
    check_neighbours({horizon(), horizon(2), wall(1.5, -1, 1.5, 5), wall(1.5, 1, 1.5, 7),
                      wall(-1, 0.5, 5, 0.5), horizon(1), wall(1.5, 0, 1.5, 3)});
}
