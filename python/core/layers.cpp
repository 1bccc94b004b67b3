// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/layers/layers.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

py::tuple stack(const py::sequence& surfaces,
                const std::vector<std::pair<std::uint32_t, double>>& order, double min_thickness,
                std::optional<double> max_move, const HowToRun& how) {
    auto given = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    std::vector<Layer> layers;
    for (const auto& [surface, hardness] : order) require_below(surface, given->size(), "surface");
    for (const auto& [surface, hardness] : order) layers.push_back({SurfaceId(surface), hardness});
    const LayerOptions options{.min_thickness = min_thickness, .max_move = max_move};
    const auto made = run_stage(how, [given, layers, options](const Run& run) {
        return stack_layers(*given, layers, options, run);
    });
    const auto layers_made =
        rows(made.reports, &LayerReport::surface, &LayerReport::dropped, &LayerReport::taken,
             &LayerReport::parts, &LayerReport::dropped_area, &LayerReport::taken_area,
             &LayerReport::largest_move, &LayerReport::step_length);
    const auto wrong = rows(made.out_of_order, &OutOfOrder::upper, &OutOfOrder::lower,
                            &OutOfOrder::triangles, &OutOfOrder::place, &OutOfOrder::depth);
    const py::dict report("layers"_a = layers_made, "step_width"_a = made.step_width,
                          "min_thickness"_a = made.min_thickness, "out_of_order"_a = wrong,
                          "is_stack"_a = made.is_stack(),
                          "rounding"_a = to_dict(made.rounded.report));
    return py::make_tuple(handle_of(made.rounded.mesh, made.rounded.conforming), report);
}

} // namespace

void bind_layers(py::module_& module) {
    module.def("layers", &stack, "surfaces"_a, "order"_a, "min_thickness"_a, "max_move"_a, "how"_a);
}

} // namespace terrane::python
