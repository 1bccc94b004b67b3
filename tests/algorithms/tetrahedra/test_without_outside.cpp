// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetrahedra/without_outside.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "support/points.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"
#include <terrane/algorithms/tetgen/tetrahedra.hpp>

using namespace terrane;
using namespace test_support;

namespace {

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
    // One sheet dangles inside, another lies outside.
    const Mesh mesh = mesh_of({cube(0, 4), level(2, 1, 1, 3, 3), level(6, 0, 0, 1, 1)});
    const auto whole = tetrahedralize(mesh, {}, {});
    REQUIRE(whole);
    REQUIRE(whole.value().surfaces.back().name == "box");
    const TetrahedralMesh blocks = without_outside(whole.value());
    CHECK(six_volumes(blocks) == 6 * 64);
    CHECK(std::find(blocks.block_of.begin(), blocks.block_of.end(), 0U) == blocks.block_of.end());
    CHECK(blocks.block_of.size() == blocks.tetrahedra.size());
    CHECK(blocks.block_count == whole.value().block_count);
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
