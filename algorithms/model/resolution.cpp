// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/model/resolution.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/quality/quality.hpp>

namespace terrane {
namespace {

/// Share of the resolution by which improvement may deviate, unless it is told otherwise.
constexpr double improvement_share = 0.25;
/// Share of the wanted length by which improve() lets surfaces deviate.
constexpr double deviation_of_length = 0.05;

} // namespace

Result<Simplified> simplify_for(const ConformingMesh& mesh, const Resolution& resolution,
                                ImproveOptions& options, const RoundingOptions& rounding,
                                const Run& run) {
    return guarded("to simplify the mesh", "simplify", [&]() -> Result<Simplified> {
        if (options.max_deviation == 0) {
            options.max_deviation = improvement_share * resolution.length;
            if (options.edge_length > 0)
                options.max_deviation =
                    std::min(options.max_deviation, deviation_of_length * options.edge_length);
        }
        if (resolution.length > 0 && !(options.max_deviation < resolution.length))
            return Error{ErrorCode::bad_option, "must be less than the resolution",
                         "max_deviation"};
        return simplify(mesh,
                        {.resolution = resolution.length,
                         .max_move = resolution.length - options.max_deviation,
                         .edge_length = options.edge_length,
                         .dissolve = resolution.dissolve,
                         .rounding = rounding},
                        run);
    });
}

Status simplify_to(const Resolution& resolution, ImproveOptions& options,
                   const RoundingOptions& rounding, Arranged& arranged, const Run& run) {
    return guarded("to simplify the mesh", "simplify", [&]() -> Status {
        auto simplified =
            simplify_for(*arranged.rounded.conforming, resolution, options, rounding, run);
        if (!simplified) return simplified.error();
        arranged.simplified = AtResolution{arranged.rounded.mesh, std::move(simplified->report)};
        arranged.surfaces = std::move(simplified->surfaces);
        arranged.exact = std::move(simplified->exact);
        arranged.rounded = std::move(simplified->rounded);
        return Done{};
    });
}

std::vector<std::uint32_t> beyond_resolution(const AtResolution& simplified, const Mesh& improved,
                                             const Run& run) {
    const SimplifyReport& r = simplified.report;
    std::vector<std::uint32_t> beyond;
    for (std::uint32_t s = 0; s < improved.surfaces.size(); ++s) {
        if (std::find(r.vanished.begin(), r.vanished.end(), s) != r.vanished.end()) continue;
        const Surface old = surface_of_mesh(*simplified.before, s);
        const Surface now = surface_of_mesh(improved, s);
        if (!is_within(now, old, r.resolution, run) || !is_within(old, now, r.resolution, run))
            beyond.push_back(s);
    }
    return beyond;
}

bool is_within_resolution(const AtResolution& simplified, const Mesh& improved, const Run& run) {
    return beyond_resolution(simplified, improved, run).empty();
}

Result<ImprovedAtResolution>
improve_at_resolution(const ConformingMesh& mesh, const Resolution& resolution,
                      ImproveOptions options, const RoundingOptions& rounding, const Run& run) {
    return guarded("to simplify the mesh", "simplify", [&]() -> Result<ImprovedAtResolution> {
        auto simplified = simplify_for(mesh, resolution, options, rounding, run);
        if (!simplified) return simplified.error();
        auto improved = improve_and_measure(*simplified->rounded.conforming, options, run);
        if (!improved) return improved.error();
        if (!is_within_resolution({mesh.mesh(), simplified->report}, improved->improved.mesh, run))
            return Error{
                ErrorCode::bad_option,
                "not all of each surface is shown to be within the resolution of what it was; "
                "try a smaller value",
                "max_deviation"};
        return ImprovedAtResolution{std::move(*simplified), std::move(*improved)};
    });
}

} // namespace terrane
