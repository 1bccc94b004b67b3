// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages that change surfaces before they are arranged: filled holes, ordered layers.
#include <array>

#include <terrane/algorithms/layers/order_check.hpp>
#include <terrane/algorithms/reconstruction/joining/join.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>
#include <terrane/algorithms/triangulation/point_surface.hpp>

#include "fixture.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;

std::vector<Stage> filling() {
    const Surface holed = waves(8, 1, true);
    const auto loops = needed(find_border_loops(holed));
    const BorderLoop hole = loops.back().kind == LoopKind::hole ? loops.back() : loops.front();
    const auto as_text = [](const Filling& filling) { return text_of({filling.surface}); };
    std::vector<Stage> stages;
    stages.push_back(stage(
        "find_border_loops", [holed] { return find_border_loops(holed); },
        [](const std::vector<BorderLoop>& found) { return std::to_string(found.size()); }));
    stages.push_back(stage(
        "fill_by_kriging",
        [holed, hole] { return fill_by_kriging(holed, hole, {.mesh_size = 1, .rings = 2}); },
        as_text));
    stages.push_back(stage(
        "fill_by_rbf", [holed, hole] { return fill_by_rbf(holed, hole, {.size = 1}); }, as_text));
    for (const FillMethod method : {FillMethod::kriging, FillMethod::rbf})
        stages.push_back(stage(
            method == FillMethod::rbf ? "fill_surfaces, rbf" : "fill_surfaces, kriging",
            [holed, method] {
                const std::array<FillTask, 1> tasks{
                    FillTask{SurfaceId(0), {.method = method, .mesh_size = 1, .rings = 2}}};
                return fill_surfaces(std::span(&holed, 1), tasks);
            },
            [](const FillWork& work) { return text_of({work.surfaces[0].filled}); }));
    const std::vector<FillTask> tasks{{SurfaceId(0), {.mesh_size = 1, .rings = 2}}};
    const auto found = needed(find_holes(std::span(&holed, 1), tasks));
    const auto filled = needed(fill_surfaces(std::span(&holed, 1), tasks));
    stages.push_back(stage(
        "find_holes", [holed, tasks] { return find_holes(std::span(&holed, 1), tasks); },
        [](const FillWork& work) { return std::to_string(work.holes.size()); }));
    stages.push_back(stage_of(
        "fill_holes", [found] { return found; },
        [holed, chosen = wanted_holes(found)](FillWork work) {
            return fill_holes(std::span(&holed, 1), chosen, work);
        },
        [](const Done&) { return std::string("filled"); }));
    stages.push_back(stage(
        "contacts_of_new", [filled] { return contacts_of_new(filled); },
        [](const std::vector<NewContact>& contacts) { return std::to_string(contacts.size()); }));
    const auto larger = needed(fill_by_rbf(holed, hole, {.size = 1}));
    stages.push_back(stage(
        "join_filling", [holed, hole, larger] { return join_filling(holed, hole, larger.surface); },
        [](const Joined& joined) { return text_of({joined.surface}); }));
    stages.push_back(stage(
        "fill_and_join_by_rbf",
        [holed, hole] { return fill_and_join_by_rbf(holed, hole, {.size = 1}); },
        [](const FilledByRbf& made) { return text_of({made.joined.surface}); }));
    return stages;
}

std::vector<Stage> layering() {
    const std::array<Surface, 2> both{waves(2, 1, false), waves(2, 1.125, false)};
    const auto as_text = [](const Layered& layered) { return text_of(*layered.rounded.mesh); };
    std::vector<Stage> stages;
    for (const double thickness : {0.0, 0.25})
        stages.push_back(stage(
            "stack_layers, thickness " + shown(thickness),
            [both, thickness] {
                const std::array<Layer, 2> order{Layer{SurfaceId(0), 1}, Layer{SurfaceId(1), 2}};
                return stack_layers(both, order, {.min_thickness = thickness});
            },
            as_text));
    stages.push_back(stage_of(
        "preprocess", [both] { return std::vector(both.begin(), both.end()); },
        [](std::vector<Surface> given) -> Result<std::vector<Surface>> {
            static const Project project = needed(parse_project(
                R"({"format": "terrane-project 1", "surfaces": [{"file": "a.obj"}],
                    "fill": [{"surface": "horizon", "mesh_size": 1}],
                    "layers": {"order": [{"surface": "horizon at 1", "hardness": 1},
                                         {"surface": "horizon at 1.125", "hardness": 2}]},
                    "outputs": {"surfaces": ["obj"]}})",
                "/", "project.json"));
            auto made = preprocess(project, given);
            if (!made) return made.error();
            return given;
        },
        [](const std::vector<Surface>& surfaces) { return text_of(surfaces); }));
    stages.push_back(stage(
        "harden", [both] { return harden(both[0], both[1], Keep::upper); }, as_text));
    const std::array<Layer, 2> order{Layer{SurfaceId(0), 1}, Layer{SurfaceId(1), 2}};
    const auto layered = needed(stack_layers(both, order));
    stages.push_back(stage(
        "find_out_of_order",
        [layered] { return find_out_of_order(layered.rounded.mesh, layered.step_width); },
        [](const std::vector<OutOfOrder>& found) { return std::to_string(found.size()); }));
    return stages;
}

/// Checks of what is given, and triangles through points.
std::vector<Stage> preparing() {
    static const Surface wavy = waves(3, 1, false);
    static const std::vector<std::uint32_t> labels(wavy.triangles.size());
    const auto done = [](const Done&) { return std::string("done"); };
    const auto count = [](const auto& list) { return std::to_string(list.size()); };
    std::vector<Stage> stages;
    stages.push_back(stage(
        "conforming", [] { return conforming(wavy.vertices, wavy.triangles, labels); }, done));
    stages.push_back(stage(
        "connect_points", [] { return connect_points(wavy.vertices); }, count));
    stages.push_back(stage(
        "fill_closed_line",
        [] {
            const std::array<Point3, 4> line{Point3{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}};
            return fill_closed_line(line);
        },
        count));
    static const Surface quads =
        triangles_of({.name = "quadrilaterals",
                      .role = Role::horizon,
                      .vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                      .quads = {{0, 1, 2, 3}}});
    static const auto arranged = needed(arrange(std::span(&quads, 1)));
    static const auto rounded = needed(round_to_doubles(arranged));
    stages.push_back(stage(
        "quad_cells", [] { return quad_cells(*rounded.mesh, arranged.inputs, SurfaceId(0)); },
        [](const QuadCells& cells) { return std::to_string(cells.quad_of.size()); }));
    static const std::vector<ColumnUnit> column{
        {.name = "an upper unit with a long name", .surface = "top"}, {.name = "a lower one"}};
    stages.push_back(stage(
        "check_column", [] { return check_column(column); }, done));
    return stages;
}

} // namespace

std::vector<Stage> stages_of_surfaces() {
    auto stages = filling();
    for (Stage& s : layering()) stages.push_back(std::move(s));
    for (Stage& s : preparing()) stages.push_back(std::move(s));
    return stages;
}

} // namespace failing
