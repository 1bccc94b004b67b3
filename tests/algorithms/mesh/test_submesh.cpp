// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include <terrane/algorithms/mesh/submesh.hpp>

using namespace terrane;

namespace {

/// Puts vertex v at (v, v * v, 0), so that a point identifies its vertex.
std::vector<Point3> row_of_points(std::uint32_t count) {
    std::vector<Point3> points;
    for (std::uint32_t v = 0; v < count; ++v) points.push_back({1.0 * v, 1.0 * v * v, 0});
    return points;
}

/// Checks that the triangles have the same points as before, that each vertex has a triangle, and
/// that the vertices keep their order.
void check_part(const std::vector<Point3>& whole, const std::vector<Triangle>& before,
                const std::vector<Point3>& part, const std::vector<Triangle>& after) {
    REQUIRE(after.size() == before.size());
    std::vector<bool> seen(part.size());
    for (std::size_t t = 0; t < after.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            REQUIRE(after[t][i] < part.size());
            seen[after[t][i]] = true;
            REQUIRE(part[after[t][i]] == whole[before[t][i]]);
        }
    CHECK(std::find(seen.begin(), seen.end(), false) == seen.end());
    CHECK(std::is_sorted(part.begin(), part.end()));
    CHECK(std::adjacent_find(part.begin(), part.end()) == part.end());
}

} // namespace

TEST_CASE("submesh: parts of all sizes, one after the other, have the vertices that they use") {
    const auto whole = row_of_points(5000);
    std::mt19937 random(3);
    Submesh submesh(whole);
    for (const std::size_t count : {0U, 1U, 50U, 103U, 104U, 105U, 3000U, 2U, 200U}) {
        std::uniform_int_distribution<std::uint32_t> any(0, 4999);
        std::vector<Triangle> triangles(count);
        for (Triangle& t : triangles)
            for (std::uint32_t& v : t) v = any(random);
        const auto before = triangles;
        const auto part = submesh.cut(triangles);
        check_part(whole, before, part, triangles);
    }
}

TEST_CASE("submesh: a renumbering keeps the order, for any cells and values") {
    std::vector<std::array<std::uint32_t, 4>> cells{{1, 3, 4, 6}, {6, 4, 3, 7}};
    std::vector<int> values{0, 10, 20, 30, 40, 50, 60, 70, 80};
    const VertexRenumbering numbers(used_vertices(values.size(), cells));
    CHECK(numbers.kept() == 5);
    numbers.compact(values);
    numbers.rename(cells);
    CHECK(values == std::vector<int>{10, 30, 40, 60, 70});
    CHECK(cells == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {3, 2, 1, 4}});
}

TEST_CASE("submesh: surfaces of a mesh, also where two share a triangle") {
    Mesh mesh;
    mesh.surfaces = {{"top", Role::horizon}, {"nothing", Role::unknown}, {"fault", Role::fault}};
    mesh.vertices = row_of_points(6);
    mesh.triangles = {{5, 1, 2}, {2, 3, 5}, {3, 4, 5}};
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0});
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{0, 2});
    mesh.surfaces_of.push_back(std::vector<std::uint32_t>{2});
    const auto all = surfaces_of_mesh(mesh);
    REQUIRE(all.size() == 3);
    CHECK(all[0].name == "top");
    CHECK(all[2].role == Role::fault);
    CHECK(all[1].triangles.empty());
    CHECK(all[1].vertices.empty());
    check_part(mesh.vertices, {{5, 1, 2}, {2, 3, 5}}, all[0].vertices, all[0].triangles);
    check_part(mesh.vertices, {{2, 3, 5}, {3, 4, 5}}, all[2].vertices, all[2].triangles);
    for (std::uint32_t s = 0; s < 3; ++s) {
        const Surface one = surface_of_mesh(mesh, s);
        CHECK(one.name == all[s].name);
        CHECK(one.vertices == all[s].vertices);
        CHECK(one.triangles == all[s].triangles);
    }
    const Mesh joined = concatenate(all);
    CHECK(joined.vertices.size() == 8);
    CHECK(joined.triangles == std::vector<Triangle>{{3, 0, 1}, {1, 2, 3}, {4, 5, 7}, {5, 6, 7}});
    CHECK(joined.surfaces_of[3][0] == 2);
}
