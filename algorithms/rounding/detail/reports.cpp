// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/reports.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/id.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>
#include <terrane/algorithms/rounding/detail/vanished.hpp>

namespace terrane::rounding::detail {

namespace {

/// Returns the distances between exact vertices and those of a mesh with the same triangles.
/// Returns none for any other mesh, whose vertices do not correspond to exact points.
std::vector<double> exact_moves(const Arrangement& a, const Mesh& mesh) {
    std::vector<double> moves;
    if (mesh.triangles != a.triangles || mesh.vertices.size() != a.vertices.size()) return moves;
    moves.reserve(a.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
        moves.push_back(distance_bound(a.state->points.enclosure(a.vertices[v]), mesh.vertices[v]));
    return moves;
}

using SurfacePair = std::pair<std::uint32_t, std::uint32_t>;

/// Calls visit(vertex, pair) for all pairs of surfaces at each vertex of more than one.
template <class Visit>
void for_each_meeting(std::size_t vertices, std::span<const Triangle> triangles,
                      const IndexLists<std::uint32_t>& surfaces_of, const Visit& visit) {
    std::vector<std::uint32_t> first(vertices, no_index), last(vertices, no_index);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all; // vertices with their surfaces
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t s : surfaces_of[t])
            for (const std::uint32_t v : triangles[t]) {
                if (first[v] == no_index) first[v] = s;
                if (first[v] == s || last[v] == s) continue; // most repeat one of these
                if (last[v] == no_index) all.emplace_back(v, first[v]);
                all.emplace_back(v, last[v] = s);
            }
    sort_unique(all);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size() && all[j].first == all[i].first; ++j)
            visit(all[i].first, SurfacePair(all[i].second, all[j].second));
}

std::vector<std::size_t> regions_per_surface(std::size_t surfaces,
                                             std::span<const Region> regions) {
    std::vector<std::size_t> count(surfaces, 0);
    for (const Region& r : regions) ++count[r.surface];
    return count;
}

} // namespace

double largest_distance(std::span<const Point3> points, std::span<const Triangle> triangles,
                        std::span<const Point3> others) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Point3 low{inf, inf, inf}, high{-inf, -inf, -inf};
    const auto add = [&](const Point3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    };
    for (const Triangle& t : triangles)
        for (const std::uint32_t v : t) add(points[v]);
    for (const Point3& p : others) add(p);
    return length_bound(high.x - low.x, high.y - low.y, high.z - low.z);
}

// Most moves are in the decade of the one before.
std::array<std::size_t, 32> decades_of(std::span<const double> moves) {
    static constexpr std::array<double, 30> starts{
        1e-22, 1e-21, 1e-20, 1e-19, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13,
        1e-12, 1e-11, 1e-10, 1e-9,  1e-8,  1e-7,  1e-6,  1e-5,  1e-4,  1e-3,
        1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,   1e5,   1e6,   1e7}; // of decades 2 to 31
    std::array<std::size_t, 32> decades{};
    std::size_t d = 1;
    for (const double m : moves) {
        while (d < 31 && m >= starts[d - 1]) ++d;
        while (d > 1 && m < starts[d - 2]) --d;
        ++decades[m > 0 ? d : 0];
    }
    return decades;
}

void add_to_report(const MovedInput& moved, const Arrangement& a, const RoundingReport& first,
                   RoundedMesh& rounded) {
    RoundingReport& report = rounded.report;
    report.arranged_again = true;
    report.naive_contacts = first.naive_contacts;
    if (const auto moves = exact_moves(a, rounded.mesh); !moves.empty()) {
        report.max_move = *std::ranges::max_element(moves);
        report.moves = decades_of(moves);
        report.arranged_again = false;
        report.deviation = std::max(report.deviation, report.max_move);
    }
    report.moved_input_vertices += moved.moved;
    report.merged_vertices += moved.merged;
    report.vanished = vanished(a, rounded.mesh->parents_of);
}

bool are_parted(const Arrangement& a, const RoundedMesh& rounded) {
    const Mesh& mesh = *rounded.mesh;
    std::set<SurfacePair> joined;
    for_each_meeting(mesh.vertices.size(), mesh.triangles, mesh.surfaces_of,
                     [&](std::uint32_t, const SurfacePair& pair) { joined.insert(pair); });
    if (2 * joined.size() == a.surfaces.size() * (a.surfaces.size() - 1)) return false;
    std::set<std::uint32_t> thinned;
    for (const std::uint32_t t : rounded.report.vanished)
        thinned.insert(a.inputs.surface_of(InputTriangleId(t)));
    std::map<SurfacePair, Point3> first; // where others meet
    bool any = false;
    for_each_meeting(a.vertices.size(), a.triangles, a.surfaces_of,
                     [&](std::uint32_t v, const SurfacePair& pair) {
                         if (any || joined.contains(pair) || thinned.contains(pair.first) ||
                             thinned.contains(pair.second))
                             return;
                         const Point3 p = a.state->points.nearest(a.vertices[v]);
                         const Point3& q = first.try_emplace(pair, p).first->second;
                         any = move_bound(p, q) > stated_deviations * rounded.report.deviation;
                     });
    return any;
}

void report_vanished_regions(const Arrangement& a, RoundedMesh& rounded) {
    std::vector<Point3> places;
    for (const PointIndex v : a.vertices) places.push_back(a.state->points.nearest(v));
    const auto exact =
        find_regions(places, a.triangles, a.surfaces_of, a.state->adjacency, a.intersection_edges);
    const auto before = regions_per_surface(a.surfaces.size(), exact.regions);
    const auto after = regions_per_surface(a.surfaces.size(), rounded.regions);
    for (std::uint32_t s = 0; s < before.size(); ++s)
        if (after[s] < before[s])
            rounded.report.vanished_regions.push_back({SurfaceId(s), before[s], after[s]});
}

} // namespace terrane::rounding::detail
