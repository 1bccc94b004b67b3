// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/tolerance.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/tolerance/detail/fences.hpp>
#include <terrane/algorithms/tolerance/detail/joined_curves.hpp>
#include <terrane/algorithms/tolerance/detail/thin_cells.hpp>
#include <terrane/algorithms/tolerance/detail/tuning.hpp>

namespace terrane {

using namespace tolerance::detail;

namespace {

/// Finds the owners of rounded triangles by the exact ones that they are parts of.
class OwnersOfRounded {
public:
    OwnersOfRounded(const Arrangement& kept, const std::vector<std::vector<Owner>>& owners) :
        kept_(kept), owners_(owners) {
        for (std::uint32_t t = 0; t < kept.triangles.size(); ++t)
            pieces_[kept.parents_of[t][0]].push_back(t);
    }
    /// Returns those of the piece of the parent in which the centre of a triangle lies, or nearly.
    [[nodiscard]] const std::vector<Owner>& at(std::uint32_t parent, const Point3& centre) const {
        const auto& pieces = pieces_.at(parent);
        std::uint32_t best = pieces[0];
        double most = -std::numeric_limits<double>::infinity();
        if (pieces.size() > 1)
            for (const std::uint32_t t : pieces)
                if (const double inside = depth(centre, t); inside > most) {
                    most = inside;
                    best = t;
                }
        return owners_[best];
    }

private:
    /// Returns the least barycentric coordinate of a point in a triangle.
    [[nodiscard]] double depth(const Point3& p, std::uint32_t t) const {
        const auto& c = kept_.triangles[t];
        const Point3 &a = kept_.nearest(VertexId(c[0])), &b = kept_.nearest(VertexId(c[1])),
                     &d = kept_.nearest(VertexId(c[2]));
        const Point3 n = cross(minus(b, a), minus(d, a));
        const auto part = [&](const Point3& q, const Point3& r) {
            return dot(cross(minus(q, p), minus(r, p)), n);
        };
        return std::min({part(a, b), part(b, d), part(d, a)}) / dot(n, n);
    }

    const Arrangement& kept_;
    const std::vector<std::vector<Owner>>& owners_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> pieces_; ///< by first parent
};

/// Returns the surfaces that own the triangles of a rounded mesh, with names and roles as given.
std::vector<Surface> owned_surfaces(const Mesh& mesh, const OwnersOfRounded& owners,
                                    const std::vector<Surface>& given) {
    std::vector<Surface> surfaces;
    for (const Surface& s : given) surfaces.push_back({s.name, s.role, {}, {}, s.frame});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Point3 centre = centre_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
        for (const Owner& o : owners.at(mesh.parents_of[t][0], centre))
            surfaces[o.surface].triangles.push_back(o.is_reversed ? Triangle{a, c, b}
                                                                  : Triangle{a, b, c});
    }
    Submesh parts(mesh.vertices);
    for (Surface& s : surfaces) s.vertices = parts.cut(s.triangles);
    return surfaces;
}

/// Joins surfaces that move by no more than about `bound`.
Result<JoinedSurfaces> join_by(const std::vector<Surface>& given, double bound,
                               const ToleranceOptions& options, const Run& run) {
    JoinedSurfaces joined{given, {}};
    auto all = given;
    joined.report.vertices = join_curves(all, tuning.curve_share * bound);
    all.push_back(fences_of(all, bound));
    const auto a = arrange(all, options.arrange, run);
    if (!a) return a.error();
    auto found = join_thin_cells(*a, bound, run);
    if (!found) return found.error();
    joined.report.cells = found->cells;
    joined.report.volume = found->volume;
    joined.report.left = std::move(found->left);
    if (found->cells == 0 && joined.report.vertices == 0) return joined;
    std::vector<bool> keep;
    for (const auto& owners : found->owners) keep.push_back(!owners.empty());
    std::erase_if(found->owners, [](const auto& owners) { return owners.empty(); });
    const Arrangement kept = restricted(*a, keep);
    const auto rounded = round_to_doubles(kept, options.rounding, run);
    if (!rounded) return rounded.error();
    joined.surfaces = owned_surfaces(rounded->mesh, {kept, found->owners}, given);
    joined.report.is_joined = true;
    return joined;
}

/// Whether each surface is shown to be within the bound of where it was, and that of it.
bool are_within(const std::vector<Surface>& before, const std::vector<Surface>& after, double bound,
                const Run& run) {
    for (std::size_t s = 0; s < before.size(); ++s)
        if (!is_within(before[s], after[s], bound, run) ||
            !is_within(after[s], before[s], bound, run))
            return false;
    return true;
}

} // namespace

Result<JoinedSurfaces> join_within(std::vector<Surface> surfaces, const ToleranceOptions& options,
                                   const Run& run) {
    return guarded("for joining", "tolerance", [&]() -> Result<JoinedSurfaces> {
        if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
            return Error{ErrorCode::bad_option, "the tolerance must be positive", "tolerance"};
        const StageTimer timer(run, "tolerance");
        const Run inner = timer.inside();
        // Moves add up where a surface is near several others: then each may be by half as much.
        for (double bound = options.tolerance; bound >= options.tolerance / 4; bound /= 2) {
            auto joined = join_by(surfaces, bound, options, inner);
            if (!joined) return joined;
            joined->report.tolerance = joined->report.largest = options.tolerance;
            if (!joined->report.is_joined ||
                are_within(surfaces, joined->surfaces, options.tolerance, inner))
                return joined;
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
        }
        JoinedSurfaces none;
        none.report.tolerance = options.tolerance;
        none.surfaces = std::move(surfaces);
        return none;
    });
}

std::vector<NamedConstant> tolerance_constants() {
    return {{"crease_cosine", tuning.crease_cosine},
            {"fence_reach", tuning.fence_reach},
            {"fence_spacings", tuning.fence_spacings},
            {"alike", tuning.alike},
            {"curve_share", tuning.curve_share}};
}

} // namespace terrane
