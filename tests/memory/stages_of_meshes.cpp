// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages from surfaces to a mesh of doubles and its regions, volumes and structure.
#include "fixture.hpp"
#include "stage.hpp"
#include "support/solids.hpp"

#include <terrane/algorithms/arrangement/known_triangles.hpp>
#include <terrane/algorithms/selection/selection.hpp>

namespace failing {
namespace {

using namespace terrane;

std::string numbers(const std::vector<double>& values) {
    std::string text;
    for (const double v : values) text += failing::shown(v) + " ";
    return text;
}

std::string count_of(const auto& list) {
    return std::to_string(list.size());
}

std::vector<Stage> arranging() {
    const Fixture& f = Fixture::get();
    const auto as_text = [](const Arrangement& a) { return text_of(a); };
    std::vector<Stage> stages;
    for (const unsigned threads : {1U, 2U})
        stages.push_back(stage(
            "arrange, threads " + std::to_string(threads),
            [&f, threads] { return arrange(f.surfaces, {}, {.threads = threads}); }, as_text));
    stages.push_back(stage(
        "arrange, search mixed", [&f] { return arrange(f.surfaces, {.search = Search::mixed}); },
        as_text));
    stages.push_back(stage(
        "arrange, known triangles",
        [&f]() -> Result<Arrangement> {
            KnownTriangles known;
            if (auto first = arrange(f.surfaces, {}, known); !first) return first;
            return arrange(f.surfaces, {}, known);
        },
        as_text));
    stages.push_back(stage(
        "round_to_doubles", [&f] { return round_to_doubles(f.arranged.exact); },
        [](const RoundedMesh& rounded) { return text_of(*rounded.mesh); }));
    stages.push_back(stage(
        "check", [&f] { return check(f.surfaces); },
        [](const CheckReport& report) { return count_of(report.contacts); }));
    stages.push_back(stage_of(
        "prove_conforming", [&f] { return *f.mesh; },
        [](Mesh mesh) { return prove_conforming(std::move(mesh)); },
        [](const ConformingMesh& mesh) { return text_of(*mesh); }));
    stages.push_back(stage(
        "find_regions", [&f] { return find_regions(*f.mesh); },
        [](const Regions& regions) { return count_of(regions.regions); }));
    const std::vector<Surface> solids{test_support::box({0, 0, 0}, {2, 2, 2}, "a"),
                                      test_support::box({1, 1, 1}, {3, 3, 3}, "b")};
    stages.push_back(stage(
        "select", [solids] { return select(solids, "a - b", {.fractions = true}); },
        [](const Selected& selected) { return text_of(selected.mesh) + selected.exact_volume; }));
    const std::vector<Surface> divided{solids[0], test_support::level(1, -1, -1, 4, 4, "t"),
                                       test_support::level(0.5, -1, -1, 4, 4, "s")};
    stages.push_back(stage(
        "select, side", [divided] { return select(divided, "a & below(t)"); },
        [](const Selected& selected) { return text_of(selected.mesh); }));
    stages.push_back(stage(
        "select, part of a surface",
        [divided] { return select(divided, "t & inside(a) & above(s)"); },
        [](const Selected& selected) { return text_of(selected.mesh); }));
    stages.push_back(stage(
        "to_exact", [&f] { return to_exact(f.arranged.exact); },
        [](const ExactText& exact) { return to_text(exact); }));
    return stages;
}

std::vector<Stage> measuring() {
    const Fixture& f = Fixture::get();
    const auto as_text = [](const Volumes& volumes) { return numbers(volumes.measures); };
    std::vector<Stage> stages;
    stages.push_back(stage(
        "find_volumes, arrangement", [&f] { return find_volumes(f.arranged.exact); }, as_text));
    stages.push_back(stage(
        "find_volumes, mesh", [&f] { return find_volumes(*f.mesh); }, as_text));
    stages.push_back(stage(
        "exact_volumes", [&f] { return exact_volumes(*f.mesh, f.volumes); },
        [](const ExactVolumes& volumes) { return volumes.total + count_of(volumes.measures); }));
    stages.push_back(stage(
        "locate_points", [&f] { return locate_points(f.mesh->vertices, *f.mesh, f.volumes); },
        [](const std::vector<std::uint32_t>& blocks) { return count_of(blocks); }));
    stages.push_back(stage(
        "block_points", [&f] { return block_points(*f.mesh, f.volumes); },
        [](const std::vector<BlockPoint>& points) { return count_of(points); }));
    stages.push_back(stage(
        "build_structure", [&f] { return build_structure(*f.mesh, f.volumes); },
        [](const Structure& structure) { return count_of(structure.lines); }));
    stages.push_back(stage(
        "find_free_borders", [&f] { return find_free_borders(*f.mesh, f.model.structure); },
        [](const std::vector<FreeBorder>& borders) { return count_of(borders); }));
    stages.push_back(stage(
        "find_relations",
        [&f] { return find_relations(*f.mesh, f.model.structure, f.model.borders); },
        [](const std::vector<SurfaceRelation>& relations) { return count_of(relations); }));
    stages.push_back(stage(
        "measure_quality", [&f] { return measure_quality(f.mesh->vertices, f.mesh->triangles); },
        [](const QualityReport&) { return std::string("measured"); }));
    stages.push_back(stage(
        "find_doubts", [&f] { return find_doubts(f.surfaces); },
        [](const std::vector<PlausibilityWarning>& doubts) { return count_of(doubts); }));
    return stages;
}

} // namespace

std::vector<Stage> stages_of_meshes() {
    auto stages = arranging();
    for (Stage& s : measuring()) stages.push_back(std::move(s));
    return stages;
}

} // namespace failing
