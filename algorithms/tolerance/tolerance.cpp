// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/tolerance.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/quality/quality.hpp>
#include <terrane/algorithms/tolerance/detail/creases.hpp>
#include <terrane/algorithms/tolerance/detail/fences.hpp>
#include <terrane/algorithms/tolerance/detail/joined_curves.hpp>
#include <terrane/algorithms/tolerance/detail/owners.hpp>
#include <terrane/algorithms/tolerance/detail/thin_cells.hpp>
#include <terrane/algorithms/tolerance/detail/tuning.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {

using namespace tolerance::detail;

namespace {

/// An arrangement, and who owns its triangles.
struct Owned {
    Arrangement exact;
    Owners owners;

    [[nodiscard]] std::vector<Point3> places() const {
        std::vector<Point3> all;
        for (std::uint32_t v = 0; v < exact.vertices.size(); ++v)
            all.push_back(exact.nearest(VertexId(v)));
        return all;
    }
    [[nodiscard]] bool has_near_vertices(double bound) const {
        std::vector<Triangle> kept;
        for (std::size_t t = 0; t < owners.size(); ++t)
            if (!owners[t].empty()) kept.push_back(exact.triangles[t]);
        return !near_vertices(places(), kept, bound).empty();
    }
    [[nodiscard]] Pieces pieces(std::span<const Point3> places) const {
        return {exact.triangles, exact.parents_of, places};
    }
};

/// Marks the input triangles that something of the result is part of, or ends at.
std::vector<bool> needed_inputs(const Owned& owned, const Run& run) {
    const Arrangement& a = owned.exact; // clang's lambdas take no names of a structured binding
    const Owners& owners = owned.owners;
    std::vector<bool> needed(a.input_corners().size(), false);
    const auto need = [&](std::uint32_t t) {
        for (const std::uint32_t p : a.parents_of[t]) needed[p] = true;
    };
    for (std::uint32_t t = 0; t < owners.size(); ++t)
        if (!owners[t].empty()) need(t);
    const auto differ = [&](std::uint32_t t, std::uint32_t u) {
        return owners[t] != owners[u] && std::ranges::any_of(a.parents_of[t], [&](std::uint32_t p) {
                   return std::ranges::binary_search(a.parents_of[u], p);
               });
    };
    group_edges(a.triangles, a.vertices.size(), run)
        .for_each([&](std::uint32_t, std::uint32_t, std::span<const EdgeSides::Side> sides) {
            for (const auto& s : sides)
                if (std::ranges::any_of(
                        sides, [&](const auto& o) { return differ(s.triangle, o.triangle); })) {
                    for (const auto& each : sides) need(each.triangle);
                    return;
                }
        });
    return needed;
}

/// Arranges the needed triangles alone, so that curves with others divide nothing any more.
Result<Owned> arrange_needed(std::vector<Surface> surfaces, const Owned& all,
                             const std::vector<bool>& closed, const ToleranceOptions& options,
                             const Run& run) {
    const auto needed = needed_inputs(all, run);
    std::vector<std::uint32_t> given; // per triangle that is left
    std::uint32_t p = 0;
    for (Surface& s : surfaces)
        std::erase_if(s.triangles, [&](const Triangle&) {
            if (needed[p]) given.push_back(p);
            return !needed[p++];
        });
    auto again = arrange(surfaces, options.arrange, run);
    if (!again) return again.error();
    Owned fewer{std::move(*again), {}};
    const auto places = fewer.places(), places_before = all.places();
    fewer.owners = owners_of(
        fewer.pieces(places), all.pieces(places_before), all.owners, closed,
        [&](std::uint32_t parent) { return given[parent]; }, run);
    return fewer;
}

/// Removes the triangles that nobody owns.
void drop_unowned(Owned& owned) {
    std::vector<bool> keep;
    for (const auto& list : owned.owners) keep.push_back(!list.empty());
    std::erase_if(owned.owners, [](const auto& list) { return list.empty(); });
    owned.exact = restricted(std::move(owned.exact), keep);
}

/// Returns the surfaces that own the triangles of a rounded mesh, with names and roles as given.
std::vector<Surface> owned_surfaces(const Mesh& mesh, const Owners& owners,
                                    const std::vector<Surface>& given) {
    std::vector<Surface> surfaces;
    for (const Surface& s : given) surfaces.push_back({s.name, s.role, {}, {}, s.frame});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        for (const Owner& o : owners[t])
            surfaces[o.surface].triangles.push_back(o.is_reversed ? Triangle{a, c, b}
                                                                  : Triangle{a, b, c});
    }
    Submesh parts(mesh.vertices);
    for (Surface& s : surfaces) s.vertices = parts.cut(s.triangles);
    return surfaces;
}

/// Counts the blocks of a mesh that are thin.
Result<std::size_t> thin_blocks(const Mesh& mesh, double bound, const Run& run) {
    const auto volumes = find_volumes(mesh, run);
    if (!volumes) return volumes.error();
    std::vector<double> area(volumes->measures.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        for (const std::uint32_t side : volumes->of_sides[t])
            area[side] += area_between(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
    std::size_t thin = 0;
    for (std::size_t v = 1; v < area.size(); ++v)
        if (2 * volumes->measures[v] <= bound * area[v]) ++thin;
    return thin;
}

/// Surfaces that were joined once, and what rounding made of them.
struct JoinedOnce {
    JoinedSurfaces joined;
    bool is_clean = true;            ///< conforming
    bool is_thin = false;            ///< has thin blocks
    std::map<Point3, Point3> near{}; ///< where near vertices go
};

/// Joins surfaces that move by no more than about `bound`. `last`: of the last pass; then only cells that
/// surfaces enclose are thin, which rounding made.
Result<JoinedOnce> join_once(const std::vector<Surface>& given, double bound,
                             const JoinedOnce* last, const ToleranceOptions& options,
                             const Run& run) {
    JoinedOnce once{{given, {}}};
    JoinedSurfaces& joined = once.joined;
    std::vector<bool> closed;
    for (const Surface& s : given)
        closed.push_back(std::ranges::all_of(
            edges_of(s), [](const SurfaceEdge& e) { return e.sides.size() % 2 == 0; }));
    auto all = given;
    if (last) {
        join_near_vertices(all, last->near);
        joined.report.vertices = last->near.size();
        all.emplace_back();
    } else {
        snap_near_vertices(all, bound);
        joined.report.vertices = join_curves(all, tuning.curve_share * bound);
        all.push_back(fences_of(all, bound));
    }
    auto exact = arrange(all, options.arrange, run);
    if (!exact) return exact.error();
    auto found = join_thin_cells(*exact, closed, bound, run);
    if (!found) return found.error();
    joined.report.cells = found->cells;
    joined.report.volume = found->volume;
    joined.report.left = std::move(found->left);
    Owned owned{std::move(*exact), std::move(found->owners)};
    if (found->cells == 0 && joined.report.vertices == 0 && !owned.has_near_vertices(bound))
        return once;
    auto fewer = arrange_needed(std::move(all), owned, closed, options, run);
    if (!fewer) return fewer.error();
    if (are_closed(fewer->pieces(fewer->places()), fewer->owners, closed, run))
        owned = std::move(*fewer);
    drop_unowned(owned);
    const auto rounded = round_to_doubles(owned.exact, options.rounding, run);
    if (!rounded) return rounded.error();
    const Mesh& mesh = rounded->mesh;
    const auto places = owned.places();
    const Pieces pieces{mesh.triangles, mesh.parents_of, mesh.vertices};
    const auto owners = owners_of(
        pieces, owned.pieces(places), owned.owners, closed,
        [](std::uint32_t parent) { return parent; }, run);
    joined.report.is_refused = !are_closed(pieces, owners, closed, run);
    if (joined.report.is_refused) return once;
    joined.surfaces = owned_surfaces(mesh, owners, given);
    joined.report.is_joined = true;
    once.is_clean = rounded->report.clean;
    if (!once.is_clean) return once;
    const auto thin = thin_blocks(mesh, bound, run);
    if (!thin) return thin.error();
    once.is_thin = *thin > joined.report.left.size();
    once.near = near_vertices(mesh.vertices, mesh.triangles, bound);
    return once;
}

/// Joins surfaces until nothing thin or short is left that can be joined.
Result<JoinedOnce> join_by(const std::vector<Surface>& surfaces, double bound,
                           const ToleranceOptions& options, const Run& run) {
    auto all = join_once(surfaces, bound, nullptr, options, run);
    for (unsigned pass = 1;
         all && (all->is_thin || !all->near.empty()) && pass < tuning.most_passes; ++pass) {
        auto once = join_once(all->joined.surfaces, bound, &*all, options, run);
        if (!once) return once;
        // What rounding makes of narrow gaps may be worse than they were.
        if (!once->joined.report.is_joined || !once->is_clean || run.stop.stop_requested()) break;
        ToleranceReport& report = once->joined.report;
        report.vertices += all->joined.report.vertices;
        report.cells += all->joined.report.cells;
        report.volume += all->joined.report.volume;
        all = std::move(once);
    }
    return all;
}

/// Whether each surface is shown to be within the bound of where it was, and that of it; and where
/// surfaces were that vanished, others are.
bool are_within(const std::vector<Surface>& before, const std::vector<Surface>& after, double bound,
                const Run& run) {
    const Mesh all = concatenate(after);
    const Surface together{"", Role::unknown, all.vertices, all.triangles};
    for (std::size_t s = 0; s < before.size(); ++s)
        if (!is_within(before[s], after[s].triangles.empty() ? together : after[s], bound, run) ||
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
        JoinedSurfaces best{{}, {.tolerance = options.tolerance, .is_refused = true}};
        for (double bound = options.tolerance; bound >= options.tolerance / 4; bound /= 2) {
            auto found = join_by(surfaces, bound, options, inner);
            if (!found) return found.error();
            JoinedSurfaces& joined = found->joined;
            joined.report.tolerance = options.tolerance;
            for (std::uint32_t s = 0; s < surfaces.size(); ++s)
                if (joined.surfaces[s].triangles.empty() && !surfaces[s].triangles.empty())
                    joined.report.vanished.push_back(s);
            const bool is_shown = !joined.report.is_refused &&
                                  (!joined.report.is_joined ||
                                   are_within(surfaces, joined.surfaces, options.tolerance, inner));
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            if (is_shown && found->is_clean) return std::move(joined);
            if (is_shown && best.report.is_refused) best = std::move(joined);
        }
        if (best.report.is_refused) best.surfaces = std::move(surfaces);
        return best;
    });
}

std::vector<NamedConstant> tolerance_constants() {
    return {{"crease_cosine", tuning.crease_cosine},
            {"fence_reach", tuning.fence_reach},
            {"fence_spacings", tuning.fence_spacings},
            {"alike", tuning.alike},
            {"least_gain", tuning.least_gain},
            {"grid_steps", tuning.grid_steps},
            {"located_spacings", tuning.located_spacings},
            {"most_passes", static_cast<double>(tuning.most_passes)},
            {"curve_share", tuning.curve_share}};
}

} // namespace terrane
