// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The blocks of many points, judged by boxes, by shifted points, and by volume_around, which follows
// other lines and looks at all triangles.
#include <terrane/algorithms/volumes/volumes.hpp>

#include <cmath>
#include <stop_token>

#include <catch2/catch.hpp>

#include "support/paths.hpp"
#include "support/random_models.hpp"
#include "support/read.hpp"
#include "support/rounded.hpp"
#include "support/solids.hpp"

using namespace terrane;
using namespace test_support;

namespace {

/// Returns the number of nested boxes that a point lies strictly inside.
std::size_t box_level_of(const Point3& p) {
    const auto in = [&](double low, double high) {
        return p.x > low && p.x < high && p.y > low && p.y < high && p.z > low && p.z < high;
    };
    return (in(0, 8) ? 1U : 0U) + (in(1, 4) ? 1U : 0U) + (in(2, 3) ? 1U : 0U);
}

std::vector<std::uint32_t> blocks_of(const std::vector<Point3>& points, const Mesh& mesh,
                                     const Volumes& volumes, unsigned threads = 1) {
    Run run;
    run.threads = threads;
    auto found = locate_points(points, mesh, volumes, run);
    INFO((found ? std::string() : found.error().message()));
    REQUIRE(found);
    return std::move(found).value();
}

} // namespace

TEST_CASE("point location: nested boxes; points on triangles, edges and vertices are shifted",
          "[volumes]") {
    const Mesh mesh = mesh_of({cube(0, 8), cube(1, 4), cube(2, 3)});
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    std::vector<Point3> points;
    for (int i = -1; i <= 17; ++i) // multiples of a half, many of them on the boxes
        for (int j = -1; j <= 17; ++j)
            for (int k = -1; k <= 17; ++k) points.push_back({i / 2.0, j / 2.0, k / 2.0});
    const auto found = blocks_of(points, mesh, *volumes);
    REQUIRE(found.size() == points.size());
    std::array<int, 4> met{};
    bool all_right = true;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Point3& at = points[p];
        const Point3 shifted{at.x + 0x1p-10, at.y + 0x1p-20, at.z + 0x1p-30};
        all_right = all_right && found[p] == box_level_of(shifted);
        ++met[found[p]];
    }
    CHECK(all_right);
    CHECK(met == std::array<int, 4>{19 * 19 * 19 - 16 * 16 * 16, 16 * 16 * 16 - 6 * 6 * 6,
                                    6 * 6 * 6 - 2 * 2 * 2, 2 * 2 * 2});
    CHECK(blocks_of(points, mesh, *volumes, 2) == found);
    CHECK(blocks_of({}, mesh, *volumes).empty());
    CHECK(blocks_of({{1, 2, 3}}, Mesh{}, Volumes{}) == std::vector<std::uint32_t>{0});
}

TEST_CASE("point location: a point on an inclined plane counts to the side of greater x",
          "[volumes]") {
    // The plane z = x / 2 + y divides the box; on it n.x decides, so that points count to the lower
    // side; on z = y, which is parallel to x, those to the lower side have the greater y.
    for (const double slope : {0.5, -0.5, 0.0}) {
        const auto height = [&](double x, double y) { return slope * x + y; };
        Surface plane{"plane", Role::unknown, {}, {}};
        add_quad(plane, {-1, -1, height(-1, -1)}, {9, -1, height(9, -1)}, {9, 9, height(9, 9)},
                 {-1, 9, height(-1, 9)});
        const Mesh mesh = mesh_of({cube(0, 8), plane});
        const auto volumes = find_volumes(mesh);
        REQUIRE(volumes);
        const auto sides = blocks_of({{4, 3, 0.5}, {4, 3, 7.5}}, mesh, *volumes);
        REQUIRE(sides[0] != sides[1]);
        std::vector<Point3> on;
        for (int i = 1; i < 16; ++i)
            for (int j = 5; j < 8; ++j) on.push_back({i / 2.0, j / 2.0, height(i / 2.0, j / 2.0)});
        for (const std::uint32_t block : blocks_of(on, mesh, *volumes))
            if (block != 0) CHECK(block == (slope < 0 ? sides[1] : sides[0]));
    }
}

TEST_CASE("point location: agrees with volume_around in random models", "[volumes]") {
    std::size_t compared = 0, inside = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        ModelMaker maker(seed);
        const auto exact = arranged(maker.model());
        const auto doubles = rounded(exact);
        if (!doubles.report.clean) continue;
        const Mesh& mesh = doubles.mesh;
        const auto volumes = find_volumes(mesh);
        REQUIRE(volumes);
        Random random(seed);
        std::vector<Point3> points;
        for (int i = 0; i < 60; ++i) // some of them have their vertical lines in edges
            points.push_back(i % 2 == 0
                                 ? point_of([&] { return random_real(random, -4, 4); })
                                 : point_of([&] { return random_int(random, -8, 8) / 2.0; }));
        const auto found = blocks_of(points, mesh, *volumes);
        for (std::size_t p = 0; p < points.size(); ++p) {
            const auto around = volume_around(points[p], mesh, *volumes);
            if (!around) continue; // on a triangle
            INFO(seed << " " << points[p].x << " " << points[p].y << " " << points[p].z);
            CHECK(found[p] == *around);
            ++compared;
            inside += found[p] == 0 ? 0U : 1U;
        }
    }
    CHECK(compared > 1500);
    CHECK(inside > 60);
}

TEST_CASE("point location: agrees with volume_around in a real model", "[volumes]") {
    const Mesh mesh = mesh_of(read_data("ringmesh/modelA2.ml"));
    const auto volumes = find_volumes(mesh);
    REQUIRE(volumes);
    Random random(7);
    std::vector<Point3> points;
    for (int i = 0; i < 60; ++i)
        points.push_back({random_real(random, -5300, 11000), random_real(random, -3600, 5900),
                          random_real(random, -1900, 3300)});
    for (int i = 0; i < 60; ++i) // under and over vertices
        points.push_back({mesh.vertices[std::size_t(97 * i) % mesh.vertices.size()].x,
                          mesh.vertices[std::size_t(97 * i) % mesh.vertices.size()].y,
                          random_real(random, -1900, 3300)});
    const auto found = blocks_of(points, mesh, *volumes);
    for (std::size_t p = 0; p < points.size(); ++p)
        if (const auto around = volume_around(points[p], mesh, *volumes); around)
            CHECK(found[p] == *around);
}

TEST_CASE("point location: a stop request is heard", "[volumes]") {
    const Mesh mesh = mesh_of({cube(0, 8)});
    std::stop_source source;
    source.request_stop();
    Run run;
    run.stop = source.get_token();
    const std::vector<Point3> points{{1, 1, 1}};
    const auto found = locate_points(points, mesh, find_volumes(mesh).value(), run);
    REQUIRE_FALSE(found);
    CHECK(found.error().code == ErrorCode::interrupted);
}
