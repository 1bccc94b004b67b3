// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/fill_stage.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf_join.hpp>
#include <terrane/cli/session/console.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_contacts = 10; ///< in words

/// A surface with one hole filled, and the expected errors of its new vertices.
struct OneFilled {
    Surface surface;
    std::vector<double> deviation; ///< per vertex after those of the surface with the hole
    FillReport report;
};

Result<OneFilled> by_kriging(const FillSettings& settings, const Surface& surface,
                             const BorderLoop& loop, std::span<const BorderLoop> loops,
                             const Run& run) {
    static const std::map<std::string, VariogramModel> models{
        {"spherical", VariogramModel::spherical},
        {"exponential", VariogramModel::exponential},
        {"gaussian", VariogramModel::gaussian},
        {"power", VariogramModel::power}};
    KrigingOptions options{
        .mesh_size = settings.mesh_size, .rings = settings.rings, .loops = loops};
    if (const auto model = models.find(settings.model); model != models.end())
        options.variogram.model = model->second;
    options.variogram.anisotropy = !settings.isotropic;
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

/// The surface that RBF gives goes beyond the border and is joined.
Result<OneFilled> by_rbf(const FillSettings& settings, const Surface& surface,
                         const BorderLoop& loop, std::span<const BorderLoop> loops,
                         const Run& run) {
    RbfOptions options;
    options.size = settings.mesh_size;
    options.loops = loops;
    options.smoothing = settings.smoothing;
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
    // Of what was joined, without the margin beyond the border.
    filled.report.expected_error =
        std::sqrt(squares / std::max(1.0, static_cast<double>(filled.deviation.size())));
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
        to.invented.push_back(static_cast<std::int32_t>(number));
    }
}

/// A hole that can't be filled is no reason to leave the others.
bool only_this_hole(ErrorCode code) {
    return code != ErrorCode::interrupted && code != ErrorCode::out_of_memory &&
           code != ErrorCode::bad_option && code != ErrorCode::internal;
}

} // namespace

Result<FillWork> find_holes(const Inputs& inputs, std::span<const FillTask> tasks,
                            Session& session) {
    FillWork work;
    session.begin("holes", Phase::computing);
    for (const FillTask& task : tasks) {
        const Surface& s = inputs.surfaces[task.surface];
        auto loops = find_border_loops(s, session.run(), {.slope = task.settings.gap_slope});
        if (!loops) return loops.error();
        for (std::size_t l = 0; l < loops.value().size(); ++l)
            if (loops.value()[l].kind != LoopKind::outer)
                work.holes.push_back({work.holes.size() + 1, work.surfaces.size(), l});
        HoledSurface holed;
        holed.task = task;
        holed.label = inputs.labels[task.surface];
        holed.loops = std::move(loops).value();
        holed.filled = s;
        holed.given_vertices = s.vertices.size();
        holed.given_triangles = s.triangles.size();
        holed.deviation.resize(s.vertices.size());
        holed.invented.resize(s.triangles.size());
        work.surfaces.push_back(std::move(holed));
    }
    session.end_stage();
    return work;
}

std::vector<bool> wanted_holes(const FillWork& work) {
    std::vector<bool> wanted;
    for (const NumberedHole& hole : work.holes) {
        const FillSettings& settings = work.surfaces[hole.task].task.settings;
        const BorderLoop& loop = loop_of(work, hole);
        wanted.push_back(loop.area <= settings.max_area &&
                         (loop.kind != LoopKind::fault_gap || settings.bridge));
    }
    return wanted;
}

Status fill_holes(const Inputs& inputs, const std::vector<bool>& chosen, FillWork& work,
                  Session& session) {
    for (std::size_t i = 0; i < work.holes.size(); ++i) {
        if (!chosen[i]) continue;
        NumberedHole& hole = work.holes[i];
        HoledSurface& to = work.surfaces[hole.task];
        const auto fill = to.task.settings.method == "rbf" ? by_rbf : by_kriging;
        session.begin(fmt::format("fill hole {}", hole.number), Phase::computing);
        const auto filled = fill(to.task.settings, inputs.surfaces[to.task.surface],
                                 loop_of(work, hole), to.loops, session.run());
        session.end_stage();
        if (filled) {
            hole.report = filled.value().report;
            take_over(filled.value(), hole.number, to);
        } else if (only_this_hole(filled.error().code)) {
            hole.refused = filled.error().message();
        } else {
            return filled.error();
        }
    }
    return Done{};
}

Result<std::string> contacts_of_new(const FillWork& work, Session& session) {
    std::string text;
    std::size_t count = 0;
    for (const HoledSurface& s : work.surfaces) {
        if (s.filled.triangles.size() == s.given_triangles) continue;
        session.begin("check", Phase::computing);
        const auto report = check(std::span(&s.filled, 1), session.run());
        session.end_stage();
        if (!report) return report.error();
        for (const ImproperContact& c : report.value().contacts) {
            const auto newer = std::max(c.triangles[0], c.triangles[1]);
            if (newer < s.given_triangles || count++ >= most_contacts) continue;
            text += fmt::format("  {}, hole {}: {} at {}\n", s.label, s.invented[newer],
                                name_of(c.kind), text_of(c.place));
        }
    }
    if (count > most_contacts) text += fmt::format("  and {} more\n", count - most_contacts);
    return text;
}

std::string refusals_text(const FillWork& work) {
    std::string text;
    for (const NumberedHole& hole : work.holes)
        if (!hole.refused.empty())
            text += fmt::format("terrane: hole {} of {} is left open: {}\n", hole.number,
                                work.surfaces[hole.task].label, hole.refused);
    return text;
}

} // namespace terrane::cli
