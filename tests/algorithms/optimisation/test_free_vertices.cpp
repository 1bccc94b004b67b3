// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Vertices on walls that move where tetrahedra are bad, as far as optimise() lets them.
#include <terrane/algorithms/optimisation/optimise.hpp>

#include "support/cubes.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

namespace free_vertices_test {

using namespace test_support;

namespace {

/// Cubes in which a vertex of the wall z = 2 is near an opposite edge of a triangle there, so that
/// tetrahedra are flat that no change inside of the blocks makes better.
TetrahedralMesh crowded_wall(std::uint32_t& moved) {
    Cubes cubes(4, 2, 0, 1);
    moved = 2 * 25 + 2 * 5 + 2;
    REQUIRE(cubes.mesh.vertices[moved] == Point3{2, 2, 2});
    cubes.mesh.vertices[moved] = {2.99, 2.5, 2};
    return cubes.mesh;
}

OptimiseOptions with_free(const TetrahedralMesh& mesh, const std::vector<std::uint32_t>& vertices) {
    OptimiseOptions options;
    options.freedom.is_free.resize(mesh.vertices.size());
    for (const std::uint32_t v : vertices) options.freedom.is_free[v] = true;
    options.freedom.place = [](std::uint32_t, const Point3& p) { return Point3{p.x, p.y, 2}; };
    return options;
}

/// Returns the corners of faces that have moved, and where they are then.
std::map<std::uint32_t, Point3> moved_corners(const TetrahedralMesh& before,
                                              const TetrahedralMesh& after) {
    std::map<std::uint32_t, Point3> moved;
    for (std::size_t f = 0; f < before.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point3& now = after.vertices[after.faces[f][k]];
            if (!(now == before.vertices[before.faces[f][k]])) moved[before.faces[f][k]] = now;
        }
    return moved;
}

} // namespace

TEST_CASE("optimise: a free vertex on a wall moves where tetrahedra are bad, as it may",
          "[optimisation]") {
    std::uint32_t crowded = 0;
    const TetrahedralMesh before = crowded_wall(crowded);
    const double bad = std::sin(10 * std::numbers::pi / 180);
    TetrahedralMesh fixed = before;
    REQUIRE(optimise(fixed));
    CHECK(least_quality(fixed) < bad);
    CHECK(moved_corners(before, fixed).empty());

    TetrahedralMesh free = before;
    const auto report = optimise(free, with_free(before, {crowded}));
    REQUIRE(report);
    CHECK(report->loosened > 0);
    CHECK(report->loosened <= report->moved);
    CHECK(least_quality(free) > bad);
    const auto moved = moved_corners(before, free);
    REQUIRE(moved.size() == 1);
    CHECK(moved.count(crowded) == 1);
    CHECK(moved.at(crowded).z == 2); // the wall stays a plane, so both blocks keep their volumes
    for (const std::uint32_t block : {1U, 2U})
        CHECK(six_volumes(free, block) == six_volumes(before, block));
    for (const Cell& c : free.tetrahedra) {
        const auto p = corners_of(free, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }

    SECTION("the other vertices at the flat tetrahedra may be the ones that move") {
        TetrahedralMesh other = before;
        REQUIRE(optimise(other, with_free(before, {crowded + 1})));
        for (const auto& [v, at] : moved_corners(before, other)) CHECK(v == crowded + 1);
    }
    SECTION("it stays where no place is known") {
        auto options = with_free(before, {crowded});
        options.freedom.place = [](std::uint32_t, const Point3&) {
            return std::optional<Point3>();
        };
        TetrahedralMesh stuck = before;
        const auto none = optimise(stuck, options);
        REQUIRE(none);
        CHECK(none->loosened == 0);
        CHECK(moved_corners(before, stuck).empty());
    }
    SECTION("it moves no farther than it must") {
        CHECK(moved.at(crowded).x > 2.5);
        CHECK(moved.at(crowded).x < 2.95);
    }
    SECTION("vertices that are free stay where tetrahedra are not bad") {
        const TetrahedralMesh good = Cubes(4, 2, 0.2, 3).mesh;
        std::vector<std::uint32_t> all;
        for (std::uint32_t v = 0; v < good.vertices.size(); ++v)
            if (good.vertices[v].z == 2) all.push_back(v);
        TetrahedralMesh same = good;
        const auto none = optimise(same, with_free(good, all));
        REQUIRE(none);
        CHECK(none->loosened == 0);
        CHECK(moved_corners(good, same).empty());
    }
    SECTION("any number of threads gives the same result") {
        Run run;
        run.threads = 4;
        TetrahedralMesh parallel = before;
        REQUIRE(optimise(parallel, with_free(before, {crowded}), run));
        CHECK(parallel.vertices == free.vertices);
        CHECK(parallel.tetrahedra == free.tetrahedra);
    }
    SECTION("at another scale it moves to the same place") {
        TetrahedralMesh large = before;
        for (Point3& p : large.vertices) p = {0x1p40 * p.x, 0x1p40 * p.y, 0x1p40 * p.z};
        auto options = with_free(before, {crowded});
        options.freedom.place = [](std::uint32_t, const Point3& p) {
            return Point3{p.x, p.y, 0x1p41};
        };
        const TetrahedralMesh given = large;
        REQUIRE(optimise(large, options));
        CHECK(moved_corners(given, large).at(crowded) ==
              Point3{0x1p40 * moved.at(crowded).x, 0x1p40 * moved.at(crowded).y, 0x1p41});
    }
    SECTION("freedom is given for all vertices or for none") {
        TetrahedralMesh mesh = before;
        auto options = with_free(before, {crowded});
        options.freedom.is_free.pop_back();
        CHECK(optimise(mesh, options).error().code == ErrorCode::bad_option);
        options = with_free(before, {crowded});
        options.freedom.place = nullptr;
        CHECK(optimise(mesh, options).error().code == ErrorCode::bad_option);
        CHECK(mesh.vertices == before.vertices);
    }
}

TEST_CASE("optimise: a vertex of a surface moves where tetrahedra are needles, if it may go far",
          "[optimisation]") {
    Cubes cubes(4, 2, 0, 1);
    const std::uint32_t near = 2 * 25 + 2 * 5 + 2;
    cubes.mesh.vertices[near] = {2.96, 2, 2}; // next to (3, 2, 2)
    const TetrahedralMesh before = cubes.mesh;
    const auto least_ratio = [](const TetrahedralMesh& mesh) {
        double least = 1;
        for (const Cell& c : mesh.tetrahedra)
            least = std::min(least, mean_ratio(corners_of(mesh, c)));
        return least;
    };
    auto options = with_free(before, {near});
    TetrahedralMesh narrow = before;
    REQUIRE(optimise(narrow, options));
    CHECK(least_quality(narrow) > std::sin(10 * std::numbers::pi / 180)); // angles are good
    CHECK(least_ratio(narrow) < 0.2);
    CHECK(moved_corners(before, narrow).empty());

    options.freedom.is_wide = true;
    TetrahedralMesh wide = before;
    const auto report = optimise(wide, options);
    REQUIRE(report);
    CHECK(report->loosened > 0);
    CHECK(least_ratio(wide) >= 0.2);
    CHECK(least_quality(wide) > std::sin(10 * std::numbers::pi / 180));
    const auto moved = moved_corners(before, wide);
    REQUIRE(moved.size() == 1);
    CHECK(moved.at(near).z == 2);
    CHECK(moved.at(near).x > 2.5); // no farther than it must
    for (const std::uint32_t block : {1U, 2U})
        CHECK(six_volumes(wide, block) == six_volumes(before, block));
}

TEST_CASE("optimise: vertices of surfaces move, whatever becomes of tetrahedra outside",
          "[optimisation]") {
    std::uint32_t crowded = 0;
    TetrahedralMesh before = crowded_wall(crowded);
    for (std::uint32_t& block : before.block_of) block = block == 2 ? 0 : 1;
    const auto inner = [](const TetrahedralMesh& mesh) {
        TetrahedralMesh kept = mesh;
        kept.tetrahedra.clear();
        for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
            if (mesh.block_of[t] != 0) kept.tetrahedra.push_back(mesh.tetrahedra[t]);
        return kept;
    };
    // Above the wall, a vertex is so near to it that no place for the crowded one is good there.
    const std::uint32_t above = crowded + 25;
    REQUIRE(before.vertices[above] == Point3{2, 2, 3});
    before.vertices[above] = {2.2, 2.2, 2.05};
    for (const Cell& c : before.tetrahedra) {
        const auto p = corners_of(before, c);
        REQUIRE(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    auto options = with_free(before, {crowded});
    options.outside = false;
    TetrahedralMesh after = before;
    REQUIRE(optimise(after, options));
    CHECK(least_quality(inner(after)) > std::sin(10 * std::numbers::pi / 180));
    for (const Cell& c : after.tetrahedra) {
        const auto p = corners_of(after, c);
        CHECK(orient3d(p[0], p[1], p[2], p[3]) == Sign::Positive);
    }
    CHECK(moved_corners(before, after).count(crowded) == 1);
    CHECK(std::count(after.vertices.begin(), after.vertices.end(), before.vertices[above]) == 1);
}

} // namespace free_vertices_test
