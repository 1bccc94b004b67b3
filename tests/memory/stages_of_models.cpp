// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages about volumes of interest, gaps, blocks and tetrahedra, and the whole chain.
#include <array>
#include <optional>

#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/seal_rules.hpp>
#include <terrane/algorithms/quality/bounds_back.hpp>
#include <terrane/algorithms/tetrahedra/edge_nodes.hpp>

#include "fixture.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;

constexpr double wide = 0.1; ///< more than the gap of the fixture's fault

std::vector<Surface> with_box(const Fixture& f) {
    auto all = f.surfaces;
    all.insert(all.end(), f.box.begin(), f.box.end());
    return all;
}

std::vector<std::uint32_t> sides_of_box(const Fixture& f) {
    std::vector<std::uint32_t> sides;
    for (std::size_t s = 0; s < f.box.size(); ++s)
        sides.push_back(static_cast<std::uint32_t>(f.surfaces.size() + s));
    return sides;
}

std::vector<Stage> boundaries() {
    const auto as_text = [](const std::vector<Surface>& surfaces) { return text_of(surfaces); };
    std::vector<Stage> stages;
    stages.push_back(stage(
        "box_boundary",
        [] {
            return box_boundary({0, 0, 0}, {1, 2, 3});
        },
        as_text));
    stages.push_back(stage(
        "rotated_box_boundary",
        [] {
            return rotated_box_boundary(
                {.place = {0, 0, 0}, .is_corner = false, .lengths = {1, 2, 3}, .azimuth = 30});
        },
        as_text));
    stages.push_back(stage(
        "polygon_boundary",
        [] {
            const std::array<Point2, 4> corners{Point2{0, 0}, Point2{4, 0}, Point2{1, 1},
                                                Point2{0, 4}};
            return polygon_boundary(corners, -1, 2);
        },
        as_text));
    static const auto box = needed(box_boundary({0, 0, 0}, {1, 2, 3}));
    stages.push_back(stage(
        "closed_boundary", [] { return closed_boundary(box); }, as_text));
    return stages;
}

std::vector<Stage> cutting() {
    const Fixture& f = Fixture::get();
    const auto surfaces = with_box(f);
    const auto sides = sides_of_box(f);
    const auto all = needed(arrange(surfaces));
    std::vector<Stage> stages;
    stages.push_back(stage_of(
        "cut_to_volume", [all] { return all; },
        [sides](Arrangement a) { return cut_to_volume(std::move(a), sides); },
        [](const VolumeOfInterest& cut) { return text_of(cut.arrangement); }));
    stages.push_back(stage(
        "locate", [=] { return locate(all, sides); },
        [](const std::vector<Where>& where) { return std::to_string(where.size()); }));
    stages.push_back(stage_of(
        "extend_to_boundary", [surfaces] { return surfaces; },
        [sides](std::vector<Surface> given) {
            return extend_to_boundary(std::move(given), sides, {.limit = 4});
        },
        [](const Extended& extended) { return text_of(extended.surfaces); }));
    stages.push_back(stage_of(
        "arrange_within, sealed", [&f] { return std::pair(f.surfaces, f.box); },
        [](std::pair<std::vector<Surface>, std::vector<Surface>> given) {
            return arrange_within(std::move(given.first), std::move(given.second),
                                  {.seal = wide, .min_volume = 0.001});
        },
        [](const Arranged& arranged) { return text_of(arranged.exact); }));
    stages.push_back(stage_of(
        "join_within", [&f] { return f.surfaces; },
        [](std::vector<Surface> given) {
            return join_within(std::move(given), {.tolerance = wide});
        },
        [](const JoinedSurfaces& joined) { return text_of(joined.surfaces); }));
    stages.push_back(stage_of(
        "seal", [&f] { return f.surfaces; },
        [](std::vector<Surface> given) { return seal(std::move(given), {.distance = wide}); },
        [](const Sealed& sealed) { return text_of(sealed.surfaces); }));
    stages.push_back(stage(
        "find_gaps", [&f] { return find_gaps(f.arranged.exact, wide); },
        [](const std::vector<SurfaceGap>& gaps) { return std::to_string(gaps.size()); }));
    stages.push_back(stage(
        "advise_seal", [&f] { return advise_seal(f.surfaces, f.box); },
        [](const SealAdvice& advice) { return std::to_string(advice.trials.size()); }));
    stages.push_back(stage(
        "judge_leaks", [&f] { return judge_leaks(f.arranged, f.model.borders); },
        [](const LeakAdvice& advice) { return failing::shown(advice.distance); }));
    stages.push_back(stage_of(
        "merge_small_blocks", [&f] { return f.arranged.exact; },
        [](Arrangement a) { return merge_small_blocks(std::move(a), 1000); },
        [](const WithoutSmallBlocks& merged) { return text_of(merged.arrangement); }));
    stages.push_back(stage(
        "choose_seal, surfaces", [&f] { return choose_seal(f.surfaces, f.box); },
        [](const SealChoice& choice) { return failing::shown(choice.distance); }));
    stages.push_back(stage(
        "choose_seal, arrangement", [&f] { return choose_seal(f.arranged.exact, 8); },
        [](const SealChoice& choice) { return failing::shown(choice.distance); }));
    const std::vector<std::string> labels{f.surfaces[0].name, "top", "fault"};
    const std::vector<SurfaceInfo> infos(labels.size());
    stages.push_back(stage(
        "seal_rules_for",
        [infos, labels] { return seal_rules_for("fault/top", wide, infos, labels); },
        [](const std::vector<SealRule>& rules) { return std::to_string(rules.size()); }));
    return stages;
}

std::vector<Stage> improving() {
    const Fixture& f = Fixture::get();
    const ImproveOptions options{.edge_length = 4, .passes = 1};
    const auto improved = needed(improve(f.mesh, options));
    std::vector<Stage> stages;
    stages.push_back(stage(
        "improve", [&f, options] { return improve(f.mesh, options); },
        [](const Improved& made) { return text_of(*made.mesh); }));
    stages.push_back(stage(
        "improve_and_measure", [&f, options] { return improve_and_measure(f.mesh, options); },
        [](const ImprovedAndMeasured& made) { return text_of(*made.improved.mesh); }));
    const auto measured = needed(improve_and_measure(f.mesh, options));
    stages.push_back(stage_of(
        "with_vertices_at", [measured] { return measured.improved.mesh->vertices; },
        [&f, measured](std::vector<Point3> points) {
            return with_vertices_at(f.mesh, measured, std::move(points));
        },
        [](const std::optional<ImprovedAndMeasured>& made) {
            return made ? text_of(*made->improved.mesh) : std::string();
        }));
    stages.push_back(stage(
        "bounds_back", [&f, improved, options] { return bounds_back(*f.mesh, improved, options); },
        [](const std::vector<double>& bounds) { return failing::shown(bounds.front()); }));
    const auto as_text = [](const Model& model) {
        return text_of(*model.mesh) + std::to_string(model.volumes.measures.size());
    };
    stages.push_back(stage(
        "make_model", [&f] { return make_model(f.arranged.exact, f.mesh); }, as_text));
    stages.push_back(stage(
        "make_model, improved",
        [&f, improved] { return make_model(f.arranged.exact, f.mesh, improved); }, as_text));
    stages.push_back(stage(
        "volumes_as_found", [&f] { return volumes_as_found(f.model); },
        [](const Volumes& volumes) { return std::to_string(volumes.measures.size()); }));
    return stages;
}

std::string counts_of(const TetrahedralMesh& mesh) {
    return std::to_string(mesh.tetrahedra.size()) + " " + std::to_string(mesh.vertices.size());
}

std::vector<Stage> tetrahedra() {
    const Fixture& f = Fixture::get();
    std::vector<Stage> stages;
    stages.push_back(stage(
        "find_tetgen_helper", [] { return find_tetgen_helper(); },
        [](const std::filesystem::path& path) { return path.string(); }));
    static const std::filesystem::path shell = "/bin/sh"; // any program that can be run
    stages.push_back(stage(
        "find_gmsh_helper", [] { return find_gmsh_helper(shell); },
        [](const std::filesystem::path& path) { return path.string(); }));
    if (!find_tetgen_helper()) return stages;
    const auto made = needed(tetrahedralize(f.mesh, f.volumes, {}, {}));
    stages.push_back(stage(
        "tetrahedralize",
        [&f] {
            return tetrahedralize(
                f.mesh, f.volumes,
                {.mesher = Mesher::tetgen, .edge_length = 6, .optimise = std::nullopt}, {});
        },
        counts_of));
    stages.back().starts_process = true;
    stages.push_back(stage_of(
        "fill_blocks", [made] { return made; },
        [&f](TetrahedralMesh given) { return fill_blocks(f.model, {}, std::move(given)); },
        [](const FilledBlocks& filled) { return counts_of(filled.tetrahedra); }));
    stages.push_back(stage(
        "check_tetrahedra", [&f, made] { return check_tetrahedra(made, *f.mesh, f.volumes); },
        [](const TetrahedraReport& report) { return std::to_string(report.violations.size()); }));
    stages.push_back(stage_of(
        "optimise", [made] { return made; },
        [](TetrahedralMesh given) -> Result<TetrahedralMesh> {
            auto report =
                optimise(given, {.wanted_angle = 30, .max_passes = 1, .max_effort = 3000});
            if (!report) return report.error();
            return given;
        },
        counts_of));
    stages.push_back(stage_of(
        "adopt_volume_numbers", [made] { return made; },
        [&f](TetrahedralMesh given) { return adopt_volume_numbers(f.volumes, given); },
        [](const Done&) { return std::string("adopted"); }));
    stages.push_back(stage(
        "find_edge_nodes", [made] { return find_edge_nodes(made); },
        [](const EdgeNodes& nodes) { return std::to_string(nodes.vertices.size()); }));
    stages.push_back(stage(
        "split_nodes",
        [made] {
            const std::array<std::uint32_t, 1> fault{2};
            return split_nodes(made, fault);
        },
        counts_of));
    return stages;
}

std::vector<Stage> building() {
    const Fixture& f = Fixture::get();
    const auto project = needed(parse_project(
        R"({"format": "terrane-project 1", "folder": "a folder with a name that needs memory",
            "surfaces": [{"file": "a.obj", "role": "horizon"}],
            "volume_of_interest": {"box": {"low": [0, 0, 0], "high": [8, 8, 8]}},
            "seal": 0.1, "improve": {"edge_length": 4}, "outputs": {"surfaces": ["obj"]}})",
        "/", "project.json"));
    BuildInput input;
    input.surfaces = f.surfaces;
    input.boundary = f.box;
    return {stage_of(
        "build", [input] { return input; },
        [project](BuildInput given) { return build(project, std::move(given)); },
        [](const Built& built) { return text_of(*built.model->mesh); })};
}

} // namespace

std::vector<Stage> stages_of_models() {
    std::vector<Stage> stages;
    for (const auto& part : {boundaries(), cutting(), improving(), tetrahedra(), building()})
        stages.insert(stages.end(), part.begin(), part.end());
    return stages;
}

} // namespace failing
