// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Volumes of a mesh in tiles are those of the mesh as a whole: their numbers, measures and names.
#include "support/certified_inputs.hpp"
#include "support/effort.hpp"
#include "support/files.hpp"
#include "support/in_tiles.hpp"
#include "support/random_models.hpp"

#include <terrane/algorithms/structure/structure.hpp>
#include <terrane/algorithms/tiles/local_supersteps.hpp>
#include <terrane/algorithms/tiles/names_in_tiles.hpp>
#include <terrane/algorithms/tiles/volumes_in_tiles.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace terrane;
using namespace terrane::tiles;
using test_support::box;
using test_support::tetrahedron;

/// The volumes of all pieces, by the numbers of triangles.
struct Gathered {
    Mesh mesh;
    Volumes volumes;
    std::size_t tiles_with_triangles = 0;
};

Gathered gathered(Supersteps& tiles, const TiledReport& report) {
    Gathered all;
    auto volumes = find_volumes_in_tiles(tiles);
    if (!volumes) FAIL(volumes.error().sentence);
    all.mesh = test_support::joined(tiles, report);
    all.volumes = *std::move(volumes);
    all.volumes.of_sides.resize(report.triangles);
    REQUIRE(tiles.visit([&](Tile& b) -> Status {
        const TilePiece piece = piece_of(b);
        REQUIRE(piece.volumes_of_sides.size() == piece.triangle_ids.size());
        for (std::size_t t = 0; t < piece.triangle_ids.size(); ++t)
            all.volumes.of_sides[piece.triangle_ids[t]] = piece.volumes_of_sides[t];
        all.tiles_with_triangles += piece.triangle_ids.empty() ? 0 : 1;
        return Done{};
    }));
    return all;
}

/// Returns the number of volumes, or nothing where the doubles need repair.
std::optional<std::size_t> judge(const std::vector<Surface>& surfaces, std::size_t count) {
    CAPTURE(count);
    const Run run;
    LocalSupersteps tiles({count, {}}, run);
    const auto report = test_support::arranged(tiles, surfaces);
    if (!report.clean) return std::nullopt;
    const Gathered found = gathered(tiles, report);
    const auto expected = find_volumes(found.mesh);
    REQUIRE(expected);
    REQUIRE(found.volumes.of_sides == expected->of_sides);
    REQUIRE(found.volumes.measures == expected->measures);
    REQUIRE(found.volumes.total == expected->total);
    const auto names = name_volumes_in_tiles(tiles);
    REQUIRE(names);
    std::vector<std::string> names_of_whole;
    const Structure structure = build_structure(found.mesh, *expected);
    for (const ModelBlock& block : structure.blocks) names_of_whole.push_back(block.name);
    REQUIRE(*names == names_of_whole);
    return expected->block_count();
}

/// Two waves in a box, with boxes between them and boxes in these.
std::vector<Surface> boxed_waves() {
    auto surfaces = test_support::waves(30, 0.0123);
    surfaces.push_back(box({0.03, 0.04, -1.5}, {3.97, 3.96, 1.5}));
    for (const double x : {0.7, 1.4, 2.9})
        for (const double z : {-1.1, 0.8}) {
            surfaces.push_back(box({x, 1.3, z}, {x + 0.3, 1.6, z + 0.3}));
            surfaces.push_back(box({x + 0.1, 1.4, z + 0.1}, {x + 0.2, 1.5, z + 0.2}));
        }
    return surfaces;
}

} // namespace

TEST_CASE("volumes in tiles: random models have the volumes of one mesh", "[volumes][once]") {
    std::size_t volumes = 0, models = 0;
    const int seeds = std::max(120, test_support::cases(120)); // few of them have many volumes
    for (int seed = 0; seed < seeds; ++seed) {
        CAPTURE(seed);
        test_support::ModelMaker maker(static_cast<std::uint64_t>(seed));
        const auto surfaces = maker.model();
        for (const std::size_t count : {1, 2, 5, 8})
            if (const auto found = judge(surfaces, count)) {
                volumes += *found;
                ++models;
            }
    }
    CHECK(models > static_cast<std::size_t>(seeds));
    CHECK(volumes > 3 * models); // otherwise the models are too easy
}

TEST_CASE("volumes in tiles: certified cases", "[volumes][once]") {
    std::size_t volumes = 0;
    for (const auto& model : test_support::certified_inputs(300)) {
        CAPTURE(model.name);
        for (const std::size_t count : {1, 3, 7})
            volumes += judge(model.surfaces, count).value_or(0);
    }
    CHECK(volumes > 0);
}

TEST_CASE("volumes in tiles: shells in shells that other tiles hold", "[volumes]") {
    const auto surfaces = boxed_waves();
    for (const std::size_t count : {1, 2, 4, 9})
        CHECK(judge(surfaces, count).value_or(0) == 4 + 12);
}

TEST_CASE("volumes in tiles: the least vertex of a volume is on any of its shells", "[volumes]") {
    const std::vector<Surface> surfaces{box({4, 4, 4}, {6, 6, 6}), box({2, 2, 2}, {3, 3, 3}),
                                        box({0, 0, 0}, {9, 9, 9})};
    for (const std::size_t count : {1, 2, 5}) CHECK(judge(surfaces, count).value_or(0) == 3);
}

TEST_CASE("volumes in tiles: those with one least vertex are told apart", "[volumes]") {
    const Point3 least{-1, 0, 0};
    std::vector<Surface> surfaces;
    for (const double z : {3.0, -2.0, 1.0, -4.0, 0.0})
        surfaces.push_back(
            tetrahedron(least, {1, 0, z}, {1, 0.25, z + 0.25}, {1, -0.25, z + 0.25}));
    for (const double z : {9.0, 7.0}) // two with a face in common
        surfaces.push_back(tetrahedron(least, {1, 1, 8}, {1, -1, 8}, {1, 0, z}));
    for (const std::size_t count : {1, 2, 3, 6}) CHECK(judge(surfaces, count).value_or(0) == 7);
}

TEST_CASE("volumes in tiles: those with the same vertices are told apart", "[volumes]") {
    // A curve along edges of a box passes through its eight corners; triangles join it to a point inside.
    // Sheared, the triangle whose corners come first borders on both volumes.
    const std::vector<Point3> curve{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                    {0, 4, 4}, {4, 4, 4}, {4, 0, 4}, {0, 0, 4}};
    for (const bool sheared : {false, true})
        for (const bool reversed : {false, true}) {
            CAPTURE(sheared, reversed);
            std::vector<Surface> surfaces{box({0, 0, 0}, {4, 4, 4}),
                                          {"fan", Role::unknown, {{0.25, 0.25, 0.25}}, {}}};
            auto& fan = surfaces[1];
            fan.vertices.insert(fan.vertices.end(), curve.begin(), curve.end());
            for (std::uint32_t i = 1; i <= 8; ++i) fan.triangles.push_back({0, i, i % 8 + 1});
            for (Surface& s : surfaces) {
                for (Point3& p : s.vertices)
                    if (sheared) p.x += p.y + p.z;
                if (reversed) std::reverse(s.triangles.begin(), s.triangles.end());
            }
            if (reversed) std::swap(surfaces[0], surfaces[1]);
            for (std::size_t count = 1; count <= 9; ++count)
                CHECK(judge(surfaces, count).value_or(0) == 2);
        }
}

TEST_CASE("volumes in tiles: states in files, in threads and in memory do the same", "[volumes]") {
    const auto surfaces = boxed_waves();
    const test_support::TemporaryFolder folder;
    const Run alone, several{.threads = 2};
    LocalSupersteps in_memory({5, {}}, alone), in_threads({5, {}}, several),
        in_files({5, folder.path()}, alone);
    const Gathered expected = gathered(in_memory, test_support::arranged(in_memory, surfaces));
    CHECK(expected.tiles_with_triangles == 5);
    for (Supersteps* tiles :
         {static_cast<Supersteps*>(&in_threads), static_cast<Supersteps*>(&in_files)}) {
        const Gathered found = gathered(*tiles, test_support::arranged(*tiles, surfaces));
        CHECK(found.volumes.of_sides == expected.volumes.of_sides);
        CHECK(found.volumes.measures == expected.volumes.measures);
    }
}

TEST_CASE("volumes in tiles: a mesh without triangles has the outside alone", "[volumes]") {
    CHECK(judge({{"empty", Role::unknown, {}, {}}}, 3).value_or(1) == 0);
}
