// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the numbers of a model's blocks, and that nothing is proven or found twice on the way to
// it.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/work_count.hpp"
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#ifdef TERRANE_HAS_TETGEN
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#endif

using namespace terrane;
using namespace test_support;

TEST_CASE("model: blocks have the numbers of the exact ones where rounding loses one",
          "[volumes]") {
    const auto exact = arrange(sectors());
    REQUIRE(exact);
    const auto rounded = round_to_doubles(*exact);
    REQUIRE(rounded);
    REQUIRE(rounded->conforming);
    const auto model = make_model(*exact, *rounded->conforming);
    REQUIRE(model);
    CHECK(model->block_count() == 7);
    CHECK(model->lost == 1);
    CHECK(model->made == 0);
    CHECK(model->exact_volumes == find_volumes(*exact)->measures);
    CHECK(model->total_volume == 512);
    CHECK(model->volumes.measures == std::vector<double>{HUGE_VAL, 128, 64, 64, 64, 0, 128, 64});
    CHECK(model->structure.blocks.size() == 8);
    CHECK(model->structure.blocks[5].interfaces.empty());
    auto numbers = model->number_of; // the mesh itself numbers them in another order
    std::sort(numbers.begin(), numbers.end());
    CHECK(numbers == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 6, 7});
    const auto found = find_volumes(rounded->mesh);
    REQUIRE(found);
    const Volumes again = volumes_as_found(*model);
    CHECK(again.measures == found->measures);
    CHECK(again.of_sides == found->of_sides);

    const auto improved = improve(*rounded->conforming, {.edge_length = 2});
    REQUIRE(improved);
    REQUIRE(improved->report.sides_kept);
    const auto better = make_model(*exact, *rounded->conforming, *improved);
    REQUIRE(better);
    CHECK(better->number_of == model->number_of);
    CHECK(better->lost == 1);
    CHECK(better->mesh->triangles.size() == improved->mesh->triangles.size());
    for (std::size_t b = 1; b < 8; ++b) {
        CHECK(better->volumes.measures[b] == Approx(model->volumes.measures[b]));
        CHECK(better->structure.blocks[b].name == model->structure.blocks[b].name);
    }
}

TEST_CASE("model: each mesh is proven once, and searched for volumes once", "[volumes][once]") {
    const WorkCount count;
    const auto exact = arrange(sectors());
    REQUIRE(exact);
    const auto rounded = round_to_doubles(*exact);
    REQUIRE(rounded);
    CHECK(WorkCount::meshes_of("prove conforming") == 1);
    const auto improved = improve(*rounded->conforming, {.edge_length = 2});
    REQUIRE(improved);
    const auto model = make_model(*exact, *rounded->conforming, *improved);
    REQUIRE(model);
#ifdef TERRANE_HAS_TETGEN
    const auto filled = fill_blocks(*model, {});
    REQUIRE(filled);
    CHECK(filled->report.violations.empty());
    CHECK(filled->tetrahedra.block_count == 8);
#endif
    CHECK(WorkCount::meshes_of("prove conforming") == 2);
    CHECK(WorkCount::meshes_of("find volumes") == 2);
    CHECK(WorkCount::meshes_of("find exact volumes") == 1);
    // A mesh without its proof is proven again, which the count shows.
    REQUIRE(improve(rounded->mesh, {.edge_length = 2}));
    CHECK(WorkCount::meshes_of("prove conforming") == 0);
}

TEST_CASE("conforming mesh: only what is conforming becomes one", "[check]") {
    const auto one = [](std::vector<Surface> surfaces) {
        Mesh mesh;
        for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.surfaces.push_back({surfaces[s].name, surfaces[s].role});
            mesh.vertices.insert(mesh.vertices.end(), surfaces[s].vertices.begin(),
                                 surfaces[s].vertices.end());
            for (const Triangle& t : surfaces[s].triangles) {
                mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
                mesh.surfaces_of.push_back(std::array{s});
            }
        }
        return prove_conforming(std::move(mesh));
    };
    const auto alone = one({wall("first", 0, 0, 8, 8)});
    REQUIRE(alone);
    CHECK((*alone)->triangles.size() == 2);
    const auto crossing = one({wall("first", 0, 0, 8, 8), wall("second", 0, 8, 8, 0)});
    REQUIRE_FALSE(crossing);
    CHECK(crossing.error().code == ErrorCode::improper_contact);
}
