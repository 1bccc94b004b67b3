// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/quality/improve.hpp>

#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/progress.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/quality/bounds_back.hpp>

namespace terrane {
bool ImprovedAndMeasured::is_near_back() const {
    for (std::size_t s = 0; s < bounds_back.size(); ++s)
        if (!(bounds_back[s] <= improved.report.bound_of[s])) return false;
    return true;
}

Result<ImprovedAndMeasured> improve_and_measure(const ConformingMesh& mesh,
                                                const ImproveOptions& options, const Run& run) {
    return guarded("to measure the mesh", "improve", [&]() -> Result<ImprovedAndMeasured> {
        if (run.progress) run.progress("improve", 0);
        auto improved = improve(mesh, options, run);
        if (!improved) return improved.error();
        const StageTimer timer(run, "measure");
        if (run.progress) run.progress("measure", 0);
        constexpr double samples = 0.5; // share of the first step, an estimate
        auto deviations =
            deviations_of(mesh, improved->mesh, part_of_stage(run, "measure", 0, samples));
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        auto back =
            bounds_back(mesh, *improved, options, part_of_stage(run, "measure", samples, 1));
        if (!back) return back.error();
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        for (std::size_t s = 0; s < deviations.size(); ++s)
            if (deviations[s].out > improved->report.bound_of[s])
                return Error{ErrorCode::internal, "the surface is farther away than was shown",
                             mesh->surfaces[s].name};
        if (run.progress) run.progress("measure", 1);
        return ImprovedAndMeasured{std::move(*improved), std::move(deviations), std::move(*back)};
    });
}

Result<std::optional<ImprovedAndMeasured>>
with_vertices_at(const ConformingMesh& before, const ImprovedAndMeasured& improved,
                 std::vector<Point3> points, const PairCheckOptions& check, const Run& run) {
    using Moved = std::optional<ImprovedAndMeasured>;
    return guarded("to measure the mesh", "improve", [&]() -> Result<Moved> {
        const StageTimer timer(run, "measure");
        Mesh mesh = improved.improved.mesh;
        mesh.vertices = std::move(points);
        std::vector<std::uint32_t> labels;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            labels.push_back(mesh.surfaces_of[t][0]);
        auto proof = prove_conforming(std::move(mesh), labels, check, run);
        if (!proof && proof.error().code == ErrorCode::improper_contact) return Moved();
        if (!proof) return proof.error();
        auto volumes = find_volumes(**proof, run);
        if (!volumes) return volumes.error();
        if (volumes->of_sides != improved.improved.volumes.of_sides) return Moved();
        ImprovedAndMeasured moved = improved;
        Improved& now = moved.improved;
        now.conforming = std::move(*proof);
        now.mesh = now.conforming->mesh();
        now.volumes = std::move(*volumes);
        now.report.after = measure_quality(now.mesh->vertices, now.mesh->triangles, run);
        if (now.report.after.worst != improved.improved.report.after.worst)
            now.report.worst_cause = WorstCause::none; // nothing was tried there
        moved.deviations = deviations_of(before, now.mesh, run);
        if (run.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        return Moved(std::move(moved));
    });
}

} // namespace terrane
