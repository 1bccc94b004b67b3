// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests building a model from a project, by calls of the library.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/work_count.hpp"
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/pipeline/detail/refinement.hpp>

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

/// The largest distance from points all over the triangles of one surface to those of another.
double farthest_sample(const Surface& from, const Surface& to) {
    constexpr int steps = 8;
    double farthest = 0;
    for (const Triangle& t : from.triangles)
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const double u = double(i) / steps, v = double(j) / steps, w = 1 - u - v;
                const Point3 &a = from.vertices[t[0]], &b = from.vertices[t[1]],
                             &c = from.vertices[t[2]];
                const Point3 p{u * a.x + v * b.x + w * c.x, u * a.y + v * b.y + w * c.y,
                               u * a.z + v * b.z + w * c.z};
                double least = HUGE_VAL;
                for (const Triangle& other : to.triangles)
                    least = std::min(least, distance_to_triangle(p, to.vertices[other[0]],
                                                                 to.vertices[other[1]],
                                                                 to.vertices[other[2]]));
                farthest = std::max(farthest, least);
            }
    return farthest;
}

} // namespace

TEST_CASE("build: each mesh is proven once, and searched for volumes once", "[volumes][once]") {
    const WorkCount count;
    Project project;
    project.improve = ProjectImprove{.options = {.edge_length = 2}};
    std::size_t blocks = 8;
#ifdef TERRANE_HAS_TETGEN
    project.outputs.tetrahedra = {"vtu"};
#endif
    const auto built = build(project, {.surfaces = sectors()});
    REQUIRE(built);
    REQUIRE(built->model);
    CHECK(built->model->block_count() + 1 == blocks);
    CHECK(built->model->lost == 1);
#ifdef TERRANE_HAS_TETGEN
    REQUIRE(built->filled);
    CHECK(built->filled->report.violations.empty());
    CHECK(built->filled->tetrahedra.block_count == blocks);
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
    project.improve = ProjectImprove{.edge_length_of = {{"fourth", 1}}};
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
        project.improve = ProjectImprove{.options = {.edge_length = 2}};
        project.outputs.tetrahedra = {"vtu"};
        project.tetrahedra.refine_bad = rounds;
        project.tetrahedra.move_vertices = false;
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

    using namespace pipeline::detail;
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

TEST_CASE("build: vertices slide on the surfaces where tetrahedra are bad", "[volumes][once]") {
    // Two walls that are near each other over a width of 8, and triangles with edges of 2.
    const std::vector<Surface> surfaces{box({0, 0, 0}, {8, 8, 8}), wall("first", 0, 4, 8, 4),
                                        wall("second", 0, 4.9, 8, 4.2)};
    const auto built_with = [&](bool move) {
        Project project;
        project.improve = ProjectImprove{.options = {.edge_length = 2}};
        project.outputs.tetrahedra = {"vtu"};
        project.tetrahedra.move_vertices = move;
        auto built = build(project, {.surfaces = surfaces});
        REQUIRE(built);
        REQUIRE(built->filled->report.violations.empty());
        return std::move(*built);
    };
    const Built still = built_with(false), moved = built_with(true);
    const Mesh &before = *still.improved->improved.mesh, &after = *moved.improved->improved.mesh;
    CHECK(still.loosened.count == 0);
    CHECK(moved.loosened.count > 0);
    REQUIRE(after.triangles == before.triangles);
    CHECK(after.surfaces_of.values == before.surfaces_of.values);
    std::vector<std::set<std::uint32_t>> surfaces_at(before.vertices.size());
    for (std::size_t t = 0; t < before.triangles.size(); ++t)
        for (const std::uint32_t v : before.triangles[t])
            surfaces_at[v].insert(before.surfaces_of[t].begin(), before.surfaces_of[t].end());
    std::size_t count = 0;
    double farthest = 0;
    for (std::size_t v = 0; v < before.vertices.size(); ++v) {
        const Point3 &p = before.vertices[v], &q = after.vertices[v];
        if (p == q) continue;
        ++count;
        farthest = std::max(farthest, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
        REQUIRE(surfaces_at[v].size() == 1); // those on curves stay
        const bool on_box = q.x == 0 || q.x == 8 || q.y == 0 || q.y == 8 || q.z == 0 || q.z == 8;
        const double off_first = std::fabs(q.y - 4);
        const double off_second = std::fabs(q.y - (4.9 - q.x * .7 / 8));
        const std::array<double, 3> off{on_box ? 0.0 : 1.0, off_first, off_second};
        CHECK(off.at(*surfaces_at[v].begin()) < 1e-12);
    }
    CHECK(count == moved.loosened.count);
    CHECK(farthest == Approx(moved.loosened.farthest));
    const auto bad = [](const Built& b) {
        return pipeline::detail::bad_places(b.filled->tetrahedra, 0).bad;
    };
    CHECK(bad(moved) < bad(still));
    CHECK(moved.improved->improved.report.bound_of == still.improved->improved.report.bound_of);
    CHECK(moved.model->block_count() == still.model->block_count());
    CHECK(moved.improved->improved.volumes.of_sides == still.improved->improved.volumes.of_sides);

    Run run;
    run.threads = 3;
    Project project;
    project.improve = ProjectImprove{.options = {.edge_length = 2}};
    project.outputs.tetrahedra = {"vtu"};
    const auto parallel = build(project, {.surfaces = surfaces}, run);
    REQUIRE(parallel);
    CHECK(parallel->improved->improved.mesh->vertices == after.vertices);
    CHECK(parallel->filled->tetrahedra.vertices == moved.filled->tetrahedra.vertices);
}

TEST_CASE("build: surfaces whose vertices moved are within the bounds of improve",
          "[volumes][once]") {
    // Curved walls that come close to each other; a coarse triangle is as far from them as it may be.
    const auto curved = [](const std::string& name, double y, double bend) {
        Surface s{name, Role::fault, {}, {}};
        constexpr std::uint32_t n = 32;
        for (std::uint32_t i = 0; i <= n; ++i)
            for (const double z : {0.0, 8.0}) {
                const double x = 8.0 * i / n;
                s.vertices.push_back({x, y + bend * std::sin(x), z});
            }
        for (std::uint32_t i = 0; i < n; ++i) {
            s.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
            s.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
        }
        return s;
    };
    std::size_t moved = 0;
    for (const double gap : {0.2, 0.4}) {
        Project project;
        project.improve = ProjectImprove{.options = {.edge_length = 2, .max_deviation = 0.02}};
        project.outputs.tetrahedra = {"vtu"};
        const auto built =
            build(project, {.surfaces = {box({0, 0, 0}, {8, 8, 8}), curved("first", 4, 0.3),
                                         curved("second", 4 + gap, 0.2)}});
        REQUIRE(built);
        CHECK(built->filled->report.violations.empty());
        moved += built->loosened.count;
        const Mesh &after = *built->improved->improved.mesh,
                   &before = *built->arranged.rounded.mesh;
        for (std::uint32_t s = 0; s < after.surfaces.size(); ++s)
            CHECK(farthest_sample(surface_of_mesh(after, s), surface_of_mesh(before, s)) <=
                  0.02 * (1 + 1e-9));
    }
    CHECK(moved > 10);
}

TEST_CASE(
    "build: with a resolution, vertices move within it, and those of the boundary in its sides",
    "[volumes]") {
    constexpr double resolution = 0.5;
    const std::vector<Surface> surfaces{wall("first", -1, 4, 9, 4),
                                        wall("second", -1, 5.2, 9, 4.4)};
    Surface boundary = box({0, 0, 1}, {8, 8, 7});
    boundary.role = Role::boundary;
    Project project;
    project.improve = ProjectImprove{.options = {.edge_length = 2}};
    project.improve->resolution.length = resolution;
    project.outputs.tetrahedra = {"vtu"};
    const auto built = build(project, {.surfaces = surfaces, .boundary = {boundary}});
    REQUIRE(built);
    REQUIRE(built->arranged.simplified);
    REQUIRE(built->loosened.count > 0);
    CHECK(built->filled->report.violations.empty());
    CHECK(built->loosened.farthest <= resolution);
    const Mesh &after = *built->improved->improved.mesh,
               &before = *built->arranged.simplified->before;
    for (std::uint32_t s = 0; s < after.surfaces.size(); ++s) {
        const Surface old = surface_of_mesh(before, s), now = surface_of_mesh(after, s);
        CHECK(farthest_sample(now, old) <= resolution);
        CHECK(farthest_sample(old, now) <= resolution);
        CHECK(built->improved->improved.report.bound_of[s] >=
              built->improved->deviations[s].out); // of the improvement and the movement
    }
    for (std::size_t t = 0; t < after.triangles.size(); ++t) {
        const auto of = after.surfaces_of[t];
        if (std::none_of(of.begin(), of.end(),
                         [&](std::uint32_t s) { return after.surfaces[s].role == Role::boundary; }))
            continue;
        const auto all_at = [&](double Point3::*axis, double at) {
            return std::all_of(after.triangles[t].begin(), after.triangles[t].end(),
                               [&](std::uint32_t v) { return after.vertices[v].*axis == at; });
        };
        CHECK((all_at(&Point3::x, 0) || all_at(&Point3::x, 8) || all_at(&Point3::y, 0) ||
               all_at(&Point3::y, 8) || all_at(&Point3::z, 1) || all_at(&Point3::z, 7)));
    }
}

TEST_CASE("build: surfaces are simplified once, in whatever round tetrahedra are refined",
          "[volumes][once]") {
    // Both walls are simplified, and a second time would move them farther.
    constexpr double resolution = 0.5;
    const auto built = [&](unsigned rounds) {
        Project project;
        project.improve = ProjectImprove{.options = {.edge_length = 2}};
        project.improve->resolution.length = resolution;
        project.outputs.tetrahedra = {"vtu"};
        project.tetrahedra.refine_bad = rounds;
        return build(project, {.surfaces = {box({0, 0, 0}, {8, 8, 8}), wall("first", -1, 4, 9, 4),
                                            wall("second", -1, 5.2, 9, 4.1)}});
    };
    const auto once = built(0), refined = built(3);
    REQUIRE(once);
    REQUIRE(refined);
    REQUIRE(refined->rounds.size() > 1);
    REQUIRE(refined->arranged.simplified);
    const Mesh& before = *refined->arranged.simplified->before;
    CHECK(before.vertices == once->arranged.simplified->before->vertices);
    CHECK(before.triangles == once->arranged.simplified->before->triangles);
    CHECK(refined->arranged.rounded.mesh->vertices == once->arranged.rounded.mesh->vertices);
    const Mesh& after = *refined->improved->improved.mesh;
    for (std::uint32_t s = 0; s < after.surfaces.size(); ++s) {
        const Surface old = surface_of_mesh(before, s), now = surface_of_mesh(after, s);
        CHECK(farthest_sample(now, old) <= resolution);
        CHECK(farthest_sample(old, now) <= resolution);
    }
}
#endif

TEST_CASE("build: lengths of a refinement are not scaled below the least one", "[volumes]") {
    const auto scaled = pipeline::detail::scaled({{{1, 2, 3}, 4}, {{5, 6, 7}, 8}}, 0.5, 3);
    REQUIRE(scaled.size() == 2);
    CHECK(scaled[0].place == Point3{1, 2, 3});
    CHECK(scaled[0].length == 3);
    CHECK(scaled[1].length == 4);
}
