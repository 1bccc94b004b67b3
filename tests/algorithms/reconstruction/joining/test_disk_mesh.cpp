// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks what removing vertices and swapping edges must preserve.
#include <terrane/algorithms/reconstruction/joining/disk_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "support/shapes.hpp"

using namespace terrane;
using namespace test_support;

namespace {

struct Measures {
    double area = 0, worst = 1;
    std::size_t border = 0; ///< edges with one triangle
    long euler = 0;         ///< V - E + F
};

/// Measures a flat mesh and checks that every edge has at most one triangle on each side.
Measures measure(const DiskMesh& mesh) {
    Measures m;
    std::map<std::array<std::uint32_t, 2>, int> sides; // by direction
    std::vector<bool> used(mesh.points().size(), false);
    const auto triangles = mesh.triangles();
    for (const Triangle& t : triangles) {
        const auto& p = mesh.points();
        const Point3 &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
        m.area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
        m.worst = std::min(m.worst, shape(a, b, c, {0, 0, 1}));
        for (unsigned k = 0; k < 3; ++k) {
            used[t[k]] = true;
            CHECK(++sides[{t[k], t[(k + 1) % 3]}] == 1);
        }
    }
    long edges = 0;
    for (const auto& [edge, count] : sides) {
        const bool both = sides.count({edge[1], edge[0]}) > 0;
        m.border += both ? 0 : 1;
        edges += both && edge[0] > edge[1] ? 0 : 1;
    }
    m.euler =
        std::count(used.begin(), used.end(), true) - edges + static_cast<long>(triangles.size());
    return m;
}

} // namespace

TEST_CASE("shape: equilateral triangles are best, degenerate ones 0, flipped ones negative",
          "[join]") {
    const double h = std::sqrt(3.0) / 2;
    CHECK(shape({0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}) == Approx(1));
    CHECK(shape({0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, -1}) == Approx(-1));
    CHECK(shape({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}) == 0);
    CHECK(shape({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0, 0, 1}) == 0);
}

TEST_CASE("disk mesh: removing inner vertices does not change the covered area", "[join]") {
    const Surface s = sheet(graph([](double, double) { return 0.0; }), 0, 0, 6, 6, 9, 9, 0.24);
    DiskMesh mesh(s.vertices, s.triangles);
    const Measures before = measure(mesh);
    CHECK(before.euler == 1);
    std::size_t removed = 0;
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v) {
        if (mesh.is_at_border(v)) continue;
        removed += mesh.remove(v) ? 1 : 0;
        const Measures now = measure(mesh);
        CHECK(now.area == Approx(36));
        CHECK(now.border == before.border);
        CHECK(now.euler == 1);
        CHECK(now.worst > 0);
    }
    CHECK(removed > 50);
    // Border vertices on straight sides can be removed, too; the four corners remain, with two
    // triangles.
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v)
        if (mesh.is_alive(v)) mesh.remove(v);
    CHECK(measure(mesh).worst > 0);
    CHECK(measure(mesh).euler == 1);
}

TEST_CASE("disk mesh: swaps improve the worst shape and do not change the covered area", "[join]") {
    Surface s = sheet(graph([](double x, double) { return 0 * x; }), 0, 0, 12, 3, 9, 9, 0.24);
    DiskMesh mesh(s.vertices, s.triangles);
    const Measures before = measure(mesh);
    std::vector<std::uint32_t> all(s.vertices.size());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    CHECK(mesh.improve(all) > 0);
    const Measures after = measure(mesh);
    CHECK(after.area == Approx(before.area));
    CHECK(after.border == before.border);
    CHECK(after.worst >= before.worst);
    CHECK(mesh.improve(all) == 0);
}

TEST_CASE("disk mesh: operations that would fold the mesh or repeat an edge are refused",
          "[join]") {
    // No corner of a single triangle can be removed.
    DiskMesh lone({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    for (std::uint32_t v = 0; v < 3; ++v) CHECK(!lone.remove(v));
    CHECK(lone.triangles().size() == 1);
    const std::vector<Point3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.1, 0}};
    const std::vector<Triangle> fan{{4, 1, 2}, {4, 2, 3}, {4, 3, 0}, {4, 0, 1}};
    DiskMesh free(square, fan);
    CHECK(free.remove(4));
    CHECK(free.triangles().size() == 2);
    DiskMesh barred(square, fan, {{0, 2}, {1, 3}}); // both diagonals are edges elsewhere
    CHECK(!barred.remove(4));
    CHECK(barred.triangles().size() == 4);
    CHECK(!barred.move_if_sound(4, {0.5, 1.5, 0}, 0.1));
    CHECK(barred.points()[4] == square[4]);
    CHECK(barred.move_if_sound(4, {0.5, 0.5, 0}, 0.1));
}
