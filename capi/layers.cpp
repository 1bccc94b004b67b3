// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/layers/layers.hpp>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/reconstruction.h>

namespace terrane::capi::detail {
namespace {

terrane_layer_options default_stacking() noexcept {
    const LayerOptions o;
    return {sizeof(terrane_layer_options), o.min_thickness, -1, o.max_rounds, 0};
}

std::vector<Layer> order_of(const terrane_layer* layers, std::size_t count) {
    need_array(layers, count, "layers");
    std::vector<Layer> order;
    for (std::size_t i = 0; i < count; ++i) {
        need_reserved(layers[i], "layers");
        order.push_back({SurfaceId(layers[i].surface), layers[i].hardness});
    }
    return order;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_layered::terrane_layered(terrane::Layered made) :
    layered(std::move(made)), mesh(layered.rounded, nullptr) {
    for (const terrane::LayerReport& r : layered.reports)
        reports.push_back({r.surface, 0, r.dropped, r.taken, r.dropped_area, r.taken_area,
                           r.largest_move, r.step_length});
}

terrane_code terrane_layer_options_init(terrane_layer_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_stacking());
}

terrane_code terrane_stack_layers(const terrane_surfaces* surfaces, const terrane_layer* layers,
                                  size_t layer_count, const terrane_layer_options* options,
                                  const terrane_run* run, terrane_layered** out,
                                  terrane_error** error) {
    return produce(out, error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        const auto order = order_of(layers, layer_count);
        const auto wanted = options_of(options, default_stacking());
        terrane::LayerOptions stacking;
        stacking.min_thickness = wanted.min_thickness;
        stacking.max_rounds = wanted.max_rounds;
        stacking.max_move = number_or_default(wanted.max_move, "options.max_move");
        return std::make_unique<terrane_layered>(
            must(terrane::stack_layers(list, order, stacking, run_of(run))));
    });
}

void terrane_layered_free(terrane_layered* layered) {
    release(layered);
}

int terrane_layered_is_stack(const terrane_layered* layered) {
    return known(layered) && layered->layered.is_stack() ? 1 : 0;
}

const terrane_mesh* terrane_layered_mesh(const terrane_layered* layered) {
    return known(layered) ? &layered->mesh : nullptr;
}

const terrane_layer_report* terrane_layered_reports(const terrane_layered* layered, size_t* count) {
    return array_of<terrane_layer_report>(known(layered) ? &layered->reports : nullptr, count);
}

double terrane_layered_step_width(const terrane_layered* layered) {
    return known(layered) ? layered->layered.step_width : std::numeric_limits<double>::quiet_NaN();
}
