// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests building a model from a project, by calls of the library.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "support/work_count.hpp"
#include <terrane/algorithms/project/build.hpp>

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
