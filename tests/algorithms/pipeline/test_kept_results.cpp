// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that stages of build() are taken from what an earlier call kept, and that nothing of what
// was kept is trusted.
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/effort.hpp"
#include "support/work_count.hpp"
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/detail/kept_results.hpp>

using namespace terrane;
using namespace test_support;
using pipeline::detail::bytes_of;
using pipeline::detail::improved_from;
using pipeline::detail::tetrahedra_from;

namespace {

/// Keeps results in memory.
struct Memory {
    std::map<std::pair<BuildStage, std::string>, std::string> kept{};
    std::vector<BuildStage> taken{};
    std::vector<Surface> surfaces = sectors();

    [[nodiscard]] StageStore store() {
        return {
            .find = [this](BuildStage stage, const std::string& key) -> std::optional<std::string> {
                const auto at = kept.find({stage, key});
                if (at == kept.end()) return std::nullopt;
                return at->second;
            },
            .keep =
                [this](BuildStage stage, const std::string& key, const std::string& bytes) {
                    kept[{stage, key}] = bytes;
                }};
    }
    [[nodiscard]] Result<Built> build(const Project& project) {
        taken.clear();
        const BuildObserver observer{
            .begins = {}, .ended = {}, .taken = [this](BuildStage s) { taken.push_back(s); }};
        return terrane::build(project, {.surfaces = surfaces}, {}, observer, store());
    }
};

Project improving_project() {
    Project project;
    project.improve = ProjectImprove{.options = {.edge_length = 2}};
#ifdef TERRANE_HAS_TETGEN
    project.outputs.tetrahedra = {"vtu"};
#endif
    return project;
}

bool is_equal(const Mesh& a, const Mesh& b) {
    return a.surfaces == b.surfaces && a.vertices == b.vertices && a.triangles == b.triangles &&
           a.surfaces_of == b.surfaces_of && a.regions_of == b.regions_of &&
           a.intersection_edges == b.intersection_edges;
}

} // namespace

TEST_CASE("kept results: a second build takes them and is equal to the first", "[kept]") {
    Memory memory;
    const Project project = improving_project();
    const auto first = memory.build(project);
    REQUIRE(first);
    CHECK(memory.taken.empty());
    const std::size_t stages = project.outputs.tetrahedra.empty() ? 1 : 2;
    CHECK(memory.kept.size() == stages);
    const auto second = memory.build(project);
    REQUIRE(second);
    CHECK(memory.taken.size() == stages);
    CHECK(is_equal(*second->model->mesh, *first->model->mesh));
    CHECK(second->model->exact_volumes == first->model->exact_volumes);
    CHECK(second->improved->improved.near_of == first->improved->improved.near_of);
    CHECK(bytes_of(*second->improved) == bytes_of(*first->improved));
    CHECK(second->improved->is_near_back() == first->improved->is_near_back());
    if (!first->filled) return;
    CHECK(second->filled->tetrahedra.tetrahedra == first->filled->tetrahedra.tetrahedra);
    CHECK(second->filled->tetrahedra.block_of == first->filled->tetrahedra.block_of);
    CHECK(second->filled->block_names == first->filled->block_names);
}

TEST_CASE("kept results: a taken mesh is proven once more", "[kept]") {
    Memory memory;
    const Project project = improving_project();
    REQUIRE(memory.build(project));
    const WorkCount count;
    REQUIRE(memory.build(project));
    CHECK(WorkCount::meshes_of("prove conforming") == 2);
}

TEST_CASE("kept results: other options have another key", "[kept][once]") {
    Memory memory;
    Project project = improving_project();
    REQUIRE(memory.build(project));
    SECTION("edge length") {
        project.improve->options.edge_length = 2.5;
    }
    SECTION("of a surface") {
        project.improve->edge_length_of = {{"first", 3}};
    }
    SECTION("deviation") {
        project.improve->options.max_deviation = 0.01;
    }
    REQUIRE(memory.build(project));
    CHECK(std::count(memory.taken.begin(), memory.taken.end(), BuildStage::improve) == 0);
}

TEST_CASE("kept results: changed bytes give a conforming mesh of the same surfaces, or none",
          "[kept]") {
    Project project = improving_project();
    project.outputs.tetrahedra.clear();
    const auto built = build(project, {.surfaces = sectors()});
    REQUIRE(built);
    const ConformingMesh& before = *built->arranged.rounded.conforming;
    const std::string good = bytes_of(*built->improved);
    REQUIRE(*improved_from(good, before, {}, {}));
    std::mt19937 random(5);
    std::size_t refused = 0;
    for (int k = 0; k < 400; ++k) {
        std::string bytes = good;
        const std::size_t at = random() % bytes.size();
        if (k % 4 == 0)
            bytes.resize(at);
        else if (k % 4 == 1)
            bytes.insert(at, 1, static_cast<char>(random()));
        else
            bytes[at] = static_cast<char>(random());
        const auto kept = improved_from(bytes, before, {}, {});
        REQUIRE(kept);
        if (!*kept) {
            ++refused;
            continue;
        }
        const Improved& improved = (*kept)->improved;
        CHECK(conforming(improved.mesh->vertices, improved.mesh->triangles,
                         std::vector<std::uint32_t>(improved.mesh->triangles.size())));
        CHECK(improved.mesh->surfaces == before->surfaces);
        CHECK(make_model(built->arranged.exact, before, improved)); // indices are in range
    }
    CHECK(refused >= 200); // all that are shorter or longer
}

#ifdef TERRANE_HAS_TETGEN

TEST_CASE("kept results: changed tetrahedra are made again, not believed", "[kept][once]") {
    Memory memory;
    memory.surfaces.resize(3); // which stay on their sides, so that vertices move for tetrahedra
    const Project project = improving_project();
    const auto first = memory.build(project);
    REQUIRE(first);
    REQUIRE(first->improved->improved.report.sides_kept);
    std::mt19937 random(6);
    int made_again = 0;
    const int count = std::max(5, cases(12));
    constexpr std::uint32_t nowhere = UINT32_MAX / 2;
    for (int k = 0; k < count; ++k) {
        Memory forged = memory;
        for (auto& [key, bytes] : forged.kept) {
            if (key.first != BuildStage::tetrahedra) continue;
            auto mesh = tetrahedra_from(bytes);
            REQUIRE(mesh);
            auto& cell = mesh->tetrahedra[random() % mesh->tetrahedra.size()];
            if (k % 5 == 0) mesh->vertices.back().x += 0.25;
            if (k % 5 == 1) std::swap(cell[0], cell[1]);
            if (k % 5 == 2) cell[k % 4] = static_cast<std::uint32_t>(random());
            if (k % 5 == 3) mesh->face_triangle[random() % mesh->faces.size()] = nowhere;
            if (k % 5 == 4) mesh->faces[random() % mesh->faces.size()][k % 3] = nowhere;
            bytes = bytes_of(*mesh);
        }
        const auto again = forged.build(project);
        REQUIRE(again);
        REQUIRE(again->filled->report.violations.empty());
        if (forged.taken.size() == 1) ++made_again;
    }
    CHECK(3 * made_again >= 2 * count); // a moved vertex may be inside a block, and nothing wrong
}

#endif
