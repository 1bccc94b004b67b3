// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests building a model from a project, by calls of the library.
#include <catch2/catch.hpp>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/work_count.hpp"
#include <terrane/algorithms/project/build.hpp>
#include <terrane/algorithms/project/detail/refinement.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// Records the stages as they begin and end: "+arrange", "-arrange".
struct Stages {
    std::vector<std::string> seen{};

    [[nodiscard]] BuildObserver observer() {
        const auto name = [](BuildStage stage) {
            return std::vector<std::string>{"preprocess", "arrange", "improve", "blocks",
                                            "tetrahedra"}
                .at(static_cast<std::size_t>(stage));
        };
        return {.begins = [=, this](BuildStage stage) { seen.push_back("+" + name(stage)); },
                .ended = [=, this](BuildStage stage,
                                   const Built&) { seen.push_back("-" + name(stage)); }};
    }
};

} // namespace

TEST_CASE("build: each mesh is proven once, and searched for volumes once", "[volumes][once]") {
    const WorkCount count;
    Project project;
    project.improve = ProjectImprove{.edge_length = 2, .max_deviation = {}, .edge_length_of = {}};
    std::size_t regions = 8;
#ifdef TERRANE_HAS_TETGEN
    project.outputs.tetrahedra = {"vtu"};
#endif
    const auto built = build(project, {.surfaces = sectors()});
    REQUIRE(built);
    REQUIRE(built->model);
    CHECK(built->model->block_count() + 1 == regions);
    CHECK(built->model->lost == 1);
#ifdef TERRANE_HAS_TETGEN
    REQUIRE(built->filled);
    CHECK(built->filled->report.violations.empty());
    CHECK(built->filled->tetrahedra.region_count == regions);
#endif
    CHECK(WorkCount::meshes_of("prove conforming") == 2);
    CHECK(WorkCount::meshes_of("find volumes") == 2);
    CHECK(WorkCount::meshes_of("find exact volumes") == 1);
}

TEST_CASE("build: stages are observed in their order, those not asked for are left out",
          "[volumes]") {
    Project project;
    Stages stages;
    const auto observer = stages.observer();
    const auto built = build(project, {.surfaces = sectors()}, {}, observer);
    REQUIRE(built);
    CHECK_FALSE(built->improved);
    CHECK_FALSE(built->filled);
    CHECK(built->labels == std::vector<std::string>{"box", "first", "second", "third"});
    CHECK(stages.seen == std::vector<std::string>{"+arrange", "-arrange", "+blocks", "-blocks"});
}

TEST_CASE("build: a name that no surface has is an error with its key", "[volumes]") {
    Project project;
    project.source = "p.json";
    project.improve =
        ProjectImprove{.edge_length = {}, .max_deviation = {}, .edge_length_of = {{"fourth", 1}}};
    const auto built = build(project, {.surfaces = sectors()});
    REQUIRE_FALSE(built);
    CHECK(built.error().message() == "p.json: improve.edge_length_of.fourth: no surface is called "
                                     "fourth; there are box, first, second, third");
    project = {};
    project.fill.push_back({.surface = "fourth"});
    CHECK(build(project, {.surfaces = sectors()}).error().message() ==
          "fill[0].surface: no surface is called fourth; there are box, first, second, third");
}

#ifdef TERRANE_HAS_TETGEN
TEST_CASE("build: refine_bad takes the best round, and each round refines the best one before it",
          "[volumes][once]") {
    // Between two walls, tetrahedra with edges of 2 are flat.
    const std::vector<Surface> surfaces{box({0, 0, 0}, {8, 8, 8}), wall("first", 0, 4, 8, 4),
                                        wall("second", 0, 4.5, 8, 4.3)};
    const auto built_with = [&](unsigned rounds) {
        Project project;
        project.improve =
            ProjectImprove{.edge_length = 2, .max_deviation = {}, .edge_length_of = {}};
        project.outputs.tetrahedra = {"vtu"};
        project.tetrahedra.refine_bad = rounds;
        auto built = build(project, {.surfaces = surfaces});
        REQUIRE(built);
        return std::move(*built);
    };
    const Built three = built_with(3), one = built_with(1), none = built_with(0);
    const auto& rounds = three.rounds;
    const auto badness = [](const RefinementRound& r) {
        return std::tuple(r.apart, r.bad, r.misshapen);
    };
    REQUIRE(rounds.size() == 4);
    REQUIRE(three.kept_round == 1); // the two after it are no better
    CHECK(badness(rounds[1]) < badness(rounds[0]));
    CHECK_FALSE(badness(rounds[2]) < badness(rounds[1]));
    CHECK_FALSE(badness(rounds[3]) < badness(rounds[1]));
    CHECK(three.filled->tetrahedra.tetrahedra == one.filled->tetrahedra.tetrahedra);
    CHECK(three.filled->tetrahedra.vertices == one.filled->tetrahedra.vertices);

    using namespace project::detail;
    const auto sizes_of = [](const Built& built) {
        return bad_places(built.filled->tetrahedra, 0).sizes;
    };
    const auto triangles_with = [&](std::vector<std::vector<LocalSize>> refinements) {
        ImproveOptions options;
        options.edge_length = 2;
        options.refinements = std::move(refinements);
        const auto improved = improve(*none.arranged.rounded.conforming, options);
        REQUIRE(improved);
        return improved->mesh->triangles.size();
    };
    const auto first = sizes_of(none), second = sizes_of(one);
    CHECK(rounds[1].triangles == triangles_with({first}));
    CHECK(rounds[2].triangles == triangles_with({first, second}));
    CHECK(rounds[3].triangles == triangles_with({first, scaled(second, 0.7, 0)}));
}
#endif

TEST_CASE("build: lengths of a refinement are not scaled below the least one", "[volumes]") {
    const auto scaled = project::detail::scaled({{{1, 2, 3}, 4}, {{5, 6, 7}, 8}}, 0.5, 3);
    REQUIRE(scaled.size() == 2);
    CHECK(scaled[0].place == Point3{1, 2, 3});
    CHECK(scaled[0].length == 3);
    CHECK(scaled[1].length == 4);
}
