// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stages that change surfaces before they are arranged: filled holes, ordered layers.
#include <array>

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
    stages.push_back(stage(
        "harden", [both] { return harden(both[0], both[1], Keep::upper); }, as_text));
    return stages;
}

} // namespace

std::vector<Stage> stages_of_surfaces() {
    auto stages = filling();
    for (Stage& s : layering()) stages.push_back(std::move(s));
    return stages;
}

} // namespace failing
