// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/reports.hpp>

#include <algorithm>
#include <cstddef>
#include <span>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>
#include <terrane/algorithms/rounding/detail/state.hpp>

namespace terrane::rounding::detail {

namespace {

/// Returns the largest distance between exact vertices and those of a mesh with the same triangles.
/// Returns 0 for any other mesh, whose vertices do not correspond to exact points.
double largest_distance(const Arrangement& a, const Mesh& mesh) {
    double largest = 0;
    if (mesh.triangles != a.triangles) return largest;
    for (std::size_t v = 0; v < std::min(a.vertices.size(), mesh.vertices.size()); ++v)
        largest = std::max(
            largest, distance_bound(a.state->points.enclosure(a.vertices[v]), mesh.vertices[v]));
    return largest;
}

std::vector<std::size_t> regions_per_surface(std::size_t surfaces,
                                             std::span<const Region> regions) {
    std::vector<std::size_t> count(surfaces, 0);
    for (const Region& r : regions) ++count[r.surface];
    return count;
}

} // namespace

std::vector<std::uint32_t> vanished(const Arrangement& a,
                                    const IndexLists<std::uint32_t>& parents_of) {
    std::vector<bool> present(a.inputs.first.back(), false);
    for (const std::uint32_t p : parents_of.values) present[p] = true;
    std::vector<std::uint32_t> result;
    for (const std::uint32_t p : a.parents_of.values)
        if (!present[p]) result.push_back(p);
    sort_unique(result);
    return result;
}

void add_to_report(const SnappedInput& snapped, const Arrangement& a, const RoundingReport& first,
                   RoundedMesh& rounded) {
    RoundingReport& report = rounded.report;
    report.naive_contacts = first.naive_contacts;
    report.max_move = std::max((report.max_move + snapped.largest_move()) * (1 + 0x1p-52),
                               largest_distance(a, rounded.mesh));
    report.deviation =
        std::max((report.deviation + snapped.largest_move()) * (1 + 0x1p-52), report.max_move);
    report.moved_input_vertices += snapped.moved();
    report.merged_vertices += snapped.merged();
    report.vanished = vanished(a, rounded.mesh->parents_of);
}

void report_lost_regions(const Arrangement& a, RoundedMesh& rounded) {
    std::vector<Point3> places;
    for (const PointIndex v : a.vertices) places.push_back(a.state->points.nearest(v));
    const auto exact =
        find_regions(places, a.triangles, a.surfaces_of, a.state->adjacency, a.intersection_edges);
    const auto before = regions_per_surface(a.surfaces.size(), exact.regions);
    const auto after = regions_per_surface(a.surfaces.size(), rounded.regions);
    for (std::uint32_t s = 0; s < before.size(); ++s)
        if (after[s] < before[s])
            rounded.report.lost_regions.push_back({SurfaceId(s), before[s], after[s]});
}

} // namespace terrane::rounding::detail
