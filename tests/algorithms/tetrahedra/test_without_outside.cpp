// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/tetrahedra/sharpest_angle.hpp>

using namespace terrane;
using namespace test_support;

namespace {

Mesh mesh_of(const std::vector<Surface>& surfaces) {
    const auto arrangement = arrange(surfaces);
    REQUIRE(arrangement);
    auto rounded = round_to_doubles(arrangement.value());
    REQUIRE(rounded);
    return std::move(rounded.value().mesh);
}

double six_volumes(const TetrahedralMesh& m) {
    double sum = 0;
    for (const auto& [i, j, k, l] : m.tetrahedra) {
        const Point3 &a = m.vertices[i], &b = m.vertices[j], &c = m.vertices[k], &d = m.vertices[l];
        const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
        const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
        const double wx = d.x - a.x, wy = d.y - a.y, wz = d.z - a.z;
        sum += std::fabs(ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) +
                         uz * (vx * wy - vy * wx));
    }
    return sum;
}

} // namespace

TEST_CASE("without_outside: the blocks are left, and nothing else", "[tetrahedra]") {
    // A sheet dangles inside, one ends outside.
    const Mesh mesh = mesh_of({cube(0, 4), level(2, 1, 1, 3, 3), level(6, 0, 0, 1, 1)});
    const auto whole = tetrahedralize(mesh, {}, {});
    REQUIRE(whole);
    REQUIRE(whole.value().surfaces.back().name == "box");
    const TetrahedralMesh blocks = without_outside(whole.value());
    CHECK(six_volumes(blocks) == 6 * 64);
    CHECK(std::find(blocks.region_of.begin(), blocks.region_of.end(), 0U) ==
          blocks.region_of.end());
    CHECK(blocks.region_of.size() == blocks.tetrahedra.size());
    CHECK(blocks.region_count == whole.value().region_count);
    CHECK(blocks.surfaces.size() == 3);
    CHECK(blocks.surfaces_of.size() == blocks.faces.size());
    CHECK(blocks.face_triangle.size() == blocks.faces.size());
    std::size_t faces = 0;
    for (std::size_t f = 0; f < blocks.faces.size(); ++f) {
        REQUIRE(blocks.surfaces_of[f].size() == 1);
        CHECK(blocks.surfaces_of[f][0] < 2); // the sheet outside has no face left
        std::array<Point3, 3> face{}, triangle{};
        for (unsigned c = 0; c < 3; ++c) {
            face[c] = blocks.vertices[blocks.faces[f][c]];
            triangle[c] = mesh.vertices[mesh.triangles[blocks.face_triangle[f]][c]];
        }
        std::sort(face.begin(), face.end());
        std::sort(triangle.begin(), triangle.end());
        CHECK(face == triangle);
        ++faces;
    }
    CHECK(faces == 12 + 2);
    std::vector<bool> used(blocks.vertices.size(), false);
    for (const auto& t : blocks.tetrahedra)
        for (const std::uint32_t v : t) used.at(v) = true;
    CHECK(std::find(used.begin(), used.end(), false) == used.end());
}

TEST_CASE("sharpest_angle: between triangles at an edge", "[tetrahedra]") {
    CHECK_FALSE(sharpest_angle(
        mesh_of({{"one", Role::unknown, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}})));
    const auto cube_angle = sharpest_angle(mesh_of({cube(0, 2)}));
    REQUIRE(cube_angle);
    CHECK(cube_angle->degrees == Approx(90));
    // a wedge of one degree on the edge from (0, 0, 0) to (4, 0, 0)
    const double rise = std::tan(std::acos(-1.0) / 180);
    const auto wedge = sharpest_angle(
        mesh_of({{"a", Role::unknown, {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}}, {{0, 1, 2}}},
                 {"b", Role::unknown, {{0, 0, 0}, {4, 0, 0}, {2, 3, 3 * rise}}, {{0, 1, 2}}}}));
    REQUIRE(wedge);
    CHECK(wedge->degrees == Approx(1));
    CHECK(wedge->place == Point3{2, 0, 0});
}

TEST_CASE("TriangleTree: the nearest point is on the triangles, and as far as the distance",
          "[borders]") {
    CHECK(nearest_on_triangle({1, 1, 3}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{1, 1, 0});
    CHECK(nearest_on_triangle({1, -2, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{1, 0, 0});
    CHECK(nearest_on_triangle({-3, -4, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}) == Point3{0, 0, 0});
    Random random(8);
    const auto points = points_of(random, Family::uniform, 300);
    std::vector<Triangle> triangles;
    for (std::uint32_t t = 0; t < 100; ++t) triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    const TriangleTree tree(points, triangles);
    for (const Point3& p : points_of(random, Family::uniform, 200)) {
        const double d = tree.distance(p, HUGE_VAL);
        const auto near = tree.nearest(p, HUGE_VAL);
        REQUIRE(near);
        CHECK(near->distance == Approx(d).margin(1e-15));
        CHECK(length(minus(near->place, p)) == near->distance);
        if (d > 1e-9) CHECK_FALSE(tree.nearest(p, d * 0.999));
    }
    CHECK_FALSE(TriangleTree(points, {}).nearest({0, 0, 0}, HUGE_VAL));
}
