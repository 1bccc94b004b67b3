// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/fill.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/is_external.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/reconstruction/holes/expected_points.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>

namespace terrane {
namespace {

void announce(const Run& run, std::string_view stage) {
    if (run.progress) run.progress(stage, 0);
}

/// A surface with one hole filled, and the expected errors of its new vertices.
struct OneFilled {
    Surface surface;
    std::vector<double> deviation; ///< per vertex after those of the surface with the hole
    FillReport report;
};

Result<OneFilled> by_kriging(const FillOptions& wanted, const Surface& surface,
                             const BorderLoop& loop, std::span<const BorderLoop> loops,
                             const Run& run) {
    const KrigingOptions options{.model = wanted.model,
                                 .anisotropy = !wanted.isotropic,
                                 .mesh_size = wanted.mesh_size,
                                 .rings = wanted.rings,
                                 .loops = loops};
    auto filling = fill_by_kriging(surface, loop, options, run);
    if (!filling) return filling.error();
    OneFilled filled;
    filled.surface = joined(surface, filling.value());
    filled.report = std::move(filling.value().report);
    const auto border = filling.value().surface.vertices.size() - filled.report.interpolated;
    filled.deviation.assign(filling.value().expected_error.begin() +
                                static_cast<std::ptrdiff_t>(border),
                            filling.value().expected_error.end());
    return filled;
}

/// Joins the surface that RBF gives, which goes beyond the border.
Result<OneFilled> by_rbf(const FillOptions& wanted, const Surface& surface, const BorderLoop& loop,
                         std::span<const BorderLoop> loops, const Run& run) {
    RbfOptions options;
    options.size = wanted.mesh_size;
    options.loops = loops;
    options.smoothing = wanted.smoothing;
    auto made = fill_and_join_by_rbf(surface, loop, options, {.loops = loops}, run);
    if (!made) return made.error();
    auto& [filling, joined, report] = made.value();
    OneFilled filled;
    filled.report = filling.report;
    filled.report.interpolated = joined.report.new_vertices;
    filled.report.area = joined.report.area;
    double squares = 0;
    for (const auto v : joined.filling_vertices) {
        filled.deviation.push_back(filling.expected_error[v]);
        squares += filled.deviation.back() * filled.deviation.back();
    }
    // The mean is that of what was joined, without the margin beyond the border.
    if (!filled.deviation.empty())
        filled.report.expected_error =
            std::sqrt(squares / static_cast<double>(filled.deviation.size()));
    filled.surface = std::move(joined.surface);
    return filled;
}

/// Takes over what is new in `filled`, made from the surface as it was given.
void take_over(const OneFilled& filled, std::size_t number, HoledSurface& to) {
    const auto old = static_cast<std::uint32_t>(to.given_vertices);
    const auto shift = static_cast<std::uint32_t>(to.filled.vertices.size()) - old;
    const Surface& s = filled.surface;
    to.filled.vertices.insert(to.filled.vertices.end(), s.vertices.begin() + old, s.vertices.end());
    to.deviation.insert(to.deviation.end(), filled.deviation.begin(), filled.deviation.end());
    for (auto t = to.given_triangles; t < s.triangles.size(); ++t) {
        Triangle corners = s.triangles[t];
        for (auto& v : corners)
            if (v >= old) v += shift;
        to.filled.triangles.push_back(corners);
        to.interpolated.push_back(static_cast<std::int32_t>(number));
    }
}

/// Whether an error concerns one hole, so that the others can still be filled.
bool only_this_hole(ErrorCode code) {
    return !is_external(code) && code != ErrorCode::bad_option && code != ErrorCode::internal;
}

} // namespace

Result<FillWork> find_holes(std::span<const Surface> surfaces, std::span<const FillTask> tasks,
                            const Run& run) {
    return guarded("for the holes", "fill", [&]() -> Result<FillWork> {
        FillWork work;
        announce(run, "holes");
        const auto labels = unique_labels(infos_of(surfaces));
        for (const FillTask& task : tasks) {
            const Surface& s = surfaces[task.surface];
            auto loops = find_border_loops(s, run, {.slope = task.options.gap_slope});
            if (!loops) return loops.error();
            for (std::size_t l = 0; l < loops->size(); ++l)
                if ((*loops)[l].kind != LoopKind::outer)
                    work.holes.push_back({work.holes.size() + 1, work.surfaces.size(), l});
            HoledSurface holed;
            holed.task = task;
            holed.label = labels[task.surface];
            holed.loops = std::move(*loops);
            holed.filled = s;
            holed.given_vertices = s.vertices.size();
            holed.given_triangles = s.triangles.size();
            holed.deviation.resize(s.vertices.size());
            holed.interpolated.resize(s.triangles.size());
            work.surfaces.push_back(std::move(holed));
        }
        return work;
    });
}

std::vector<bool> wanted_holes(const FillWork& work) {
    std::vector<bool> wanted;
    for (const NumberedHole& hole : work.holes) {
        const FillOptions& options = work.surfaces[hole.task].task.options;
        const BorderLoop& loop = loop_of(work, hole);
        wanted.push_back(loop.area <= options.max_area &&
                         (loop.kind != LoopKind::fault_gap || options.bridge_faults));
    }
    return wanted;
}

Status fill_holes(std::span<const Surface> surfaces, const std::vector<bool>& chosen,
                  FillWork& work, const Run& run) {
    return guarded("for the filling", "fill", [&]() -> Status {
        for (std::size_t i = 0; i < work.holes.size(); ++i) { // before any is filled
            const NumberedHole& hole = work.holes[i];
            if (!chosen[i]) continue;
            if (auto sound = check_edge_length(loop_of(work, hole),
                                               work.surfaces[hole.task].task.options.mesh_size);
                !sound)
                return sound;
        }
        for (std::size_t i = 0; i < work.holes.size(); ++i) {
            if (!chosen[i]) continue;
            NumberedHole& hole = work.holes[i];
            HoledSurface& to = work.surfaces[hole.task];
            const auto fill = to.task.options.method == FillMethod::rbf ? by_rbf : by_kriging;
            announce(run, "fill hole " + std::to_string(hole.number));
            const auto filled = fill(to.task.options, surfaces[to.task.surface],
                                     loop_of(work, hole), to.loops, run);
            if (filled) {
                hole.report = filled->report;
                take_over(*filled, hole.number, to);
            } else if (only_this_hole(filled.error().code)) {
                hole.refused = filled.error().message();
            } else {
                return filled.error();
            }
        }
        return Done{};
    });
}

Result<std::vector<NewContact>> contacts_of_new(const FillWork& work, const Run& run) {
    return guarded("for the check", "fill", [&]() -> Result<std::vector<NewContact>> {
        std::vector<NewContact> found;
        for (std::size_t task = 0; task < work.surfaces.size(); ++task) {
            const HoledSurface& s = work.surfaces[task];
            if (s.filled.triangles.size() == s.given_triangles) continue;
            announce(run, "check");
            const auto report = check(std::span(&s.filled, 1), run);
            if (!report) return report.error();
            for (const ImproperContact& c : report->contacts) {
                const auto newer = std::max(c.triangles[0], c.triangles[1]);
                if (newer >= s.given_triangles)
                    found.push_back({task, s.interpolated[newer], c.kind, c.place});
            }
        }
        return found;
    });
}

Result<FillWork> fill_surfaces(std::span<const Surface> surfaces, std::span<const FillTask> tasks,
                               const Run& run) {
    return guarded("for the filling", "fill", [&]() -> Result<FillWork> {
        auto work = find_holes(surfaces, tasks, run);
        if (!work) return work;
        if (auto done = fill_holes(surfaces, wanted_holes(*work), *work, run); !done)
            return done.error();
        const auto contacts = contacts_of_new(*work, run);
        if (!contacts) return contacts.error();
        if (contacts->empty()) return work;
        const NewContact& first = contacts->front();
        return Error{ErrorCode::improper_contact,
                     "the filling of hole " + std::to_string(first.hole) +
                         " meets other triangles improperly: " + std::string(name_of(first.kind)),
                     "surface " + work->surfaces[first.task].label};
    });
}

} // namespace terrane
