// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <terrane/algorithms/reconstruction/fill.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/reconstruction.h>

namespace terrane::capi::detail {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

terrane_fill_task default_task() noexcept {
    const FillOptions o;
    return {sizeof(terrane_fill_task),
            0,
            0,
            nullptr,
            o.max_area,
            o.mesh_size,
            o.gap_slope,
            unknown,
            static_cast<std::uint32_t>(o.rings),
            0,
            0,
            0};
}

[[noreturn]] void bad_task(std::size_t task, const char* sentence, const char* member) {
    refuse(sentence, "tasks[" + std::to_string(task) + "]." + member);
}

FillTask task_of(const terrane_fill_task& given, std::size_t number, std::size_t surface_count) {
    if (given.surface >= surface_count)
        refuse(ErrorCode::bad_index, "there is no such surface",
               "tasks[" + std::to_string(number) + "].surface");
    FillTask task{SurfaceId(given.surface), {}};
    FillOptions& o = task.options;
    o.method = given.use_rbf != 0 ? FillMethod::rbf : FillMethod::kriging;
    if (given.variogram && std::string_view(given.variogram) != "auto") {
        o.model = variogram_model_named(given.variogram);
        if (!o.model) bad_task(number, "is no model of a variogram", "variogram");
    }
    if (!(given.max_area >= 0)) bad_task(number, "is negative or not a number", "max_area");
    if (!(given.mesh_size >= 0)) bad_task(number, "is negative or not a number", "mesh_size");
    if (!(given.gap_slope > 0)) bad_task(number, "is not positive", "gap_slope");
    if (given.smoothing < 0) bad_task(number, "is negative", "smoothing");
    if (given.use_rbf == 0 && !std::isnan(given.smoothing))
        bad_task(number, "is of radial basis functions", "smoothing");
    if (given.use_rbf != 0 && o.model) bad_task(number, "is of kriging", "variogram");
    if (given.use_rbf != 0 && given.is_isotropic != 0)
        bad_task(number, "is of kriging", "is_isotropic");
    o.max_area = given.max_area;
    o.mesh_size = given.mesh_size;
    o.gap_slope = given.gap_slope;
    if (!std::isnan(given.smoothing)) o.smoothing = given.smoothing;
    o.rings = given.rings;
    o.isotropic = given.is_isotropic != 0;
    o.bridge_faults = given.bridge_faults != 0;
    return task;
}

/// Returns the tasks of a caller, whose structs may be shorter than this library's.
std::vector<FillTask> tasks_of(const terrane_fill_task* given, std::size_t count,
                               std::size_t surface_count) {
    need_array(given, count, "tasks");
    std::vector<FillTask> tasks;
    std::set<std::uint32_t> surfaces;
    const std::size_t stride = count > 0 ? given->struct_size : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto* at = reinterpret_cast<const char*>(given) + i * stride;
        const auto* one = reinterpret_cast<const terrane_fill_task*>(at);
        if (one->struct_size != stride) throw BadArgument{"tasks", "have different struct_sizes"};
        auto task = task_of(options_of(one, default_task()), i, surface_count);
        if (!surfaces.insert(task.surface).second)
            bad_task(i, "is the surface of another task, too", "surface");
        tasks.push_back(std::move(task));
    }
    return tasks;
}

terrane_hole hole_of(const FillWork& work, const NumberedHole& hole) {
    const BorderLoop& loop = loop_of(work, hole);
    terrane_hole made{};
    made.surface = work.surfaces[hole.task].task.surface;
    made.is_fault_gap = loop.kind == LoopKind::fault_gap ? 1 : 0;
    made.is_filled = hole.report ? 1 : 0;
    made.length = loop.length;
    made.area = loop.area;
    give_point(loop.centre, made.centre);
    made.fault_throw = loop.fault_throw;
    made.width = loop.width;
    made.filled_area = hole.report ? hole.report->area : 0;
    made.expected_error = hole.report ? hole.report->expected_error : unknown;
    made.validated_error = hole.report ? hole.report->validated_error : unknown;
    return made;
}

const HoledSurface* filled_at(const terrane_holes* holes, std::size_t task) noexcept {
    return known(holes) && task < holes->work.surfaces.size() ? &holes->work.surfaces[task]
                                                              : nullptr;
}

/// Runs find_holes or fill_surfaces on the surfaces and tasks of a caller.
template <class Stage>
std::unique_ptr<terrane_holes> holes_by(const Stage& stage, const terrane_surfaces* surfaces,
                                        const terrane_fill_task* tasks, std::size_t task_count,
                                        const terrane_run* run) {
    const auto& list = needed(surfaces, "surfaces").list;
    const auto wanted = tasks_of(tasks, task_count, list.size());
    auto work = must(stage(list, wanted, run_of(run)));
    return std::make_unique<terrane_holes>(std::move(work));
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_holes::terrane_holes(terrane::FillWork found) : work(std::move(found)) {
    for (const terrane::NumberedHole& hole : work.holes) {
        array.push_back(hole_of(work, hole));
        borders.push_back(loop_of(work, hole).vertices);
    }
    for (terrane::HoledSurface& s : work.surfaces) surfaces.list.push_back(std::move(s.filled));
}

terrane_code terrane_fill_task_init(terrane_fill_task* task, size_t struct_size, uint32_t surface) {
    auto defaults = default_task();
    defaults.surface = surface;
    return init_options(task, struct_size, defaults);
}

terrane_code terrane_find_holes(const terrane_surfaces* surfaces, const terrane_fill_task* tasks,
                                size_t task_count, const terrane_run* run, terrane_holes** out,
                                terrane_error** error) {
    return produce(out, error,
                   [&] { return holes_by(terrane::find_holes, surfaces, tasks, task_count, run); });
}

terrane_code terrane_fill(const terrane_surfaces* surfaces, const terrane_fill_task* tasks,
                          size_t task_count, const terrane_run* run, terrane_holes** out,
                          terrane_error** error) {
    return produce(out, error, [&] {
        return holes_by(terrane::fill_surfaces, surfaces, tasks, task_count, run);
    });
}

void terrane_holes_free(terrane_holes* holes) {
    release(holes);
}

const terrane_hole* terrane_holes_array(const terrane_holes* holes, size_t* count) {
    return array_of<terrane_hole>(known(holes) ? &holes->array : nullptr, count);
}

terrane_code terrane_holes_borders(const terrane_holes* holes, terrane_lists* lists) {
    return give_lists(known(holes) ? &holes->borders : nullptr, lists);
}

const char* terrane_holes_refusal(const terrane_holes* holes, size_t hole) {
    return known(holes) && hole < holes->work.holes.size() ? holes->work.holes[hole].refused.c_str()
                                                           : nullptr;
}

const char* terrane_holes_model(const terrane_holes* holes, size_t hole) {
    if (!known(holes) || hole >= holes->work.holes.size()) return nullptr;
    const auto& report = holes->work.holes[hole].report;
    return report ? report->model.c_str() : "";
}

const terrane_surfaces* terrane_holes_surfaces(const terrane_holes* holes) {
    return known(holes) ? &holes->surfaces : nullptr;
}

const double* terrane_holes_expected_errors(const terrane_holes* holes, size_t task,
                                            size_t* vertex_count) {
    const auto* found = filled_at(holes, task);
    return array_of<double>(found ? &found->deviation : nullptr, vertex_count);
}

const int32_t* terrane_holes_of_triangles(const terrane_holes* holes, size_t task,
                                          size_t* triangle_count) {
    const auto* found = filled_at(holes, task);
    return array_of<int32_t>(found ? &found->interpolated : nullptr, triangle_count);
}
