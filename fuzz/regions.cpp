// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: regions are the connected parts of surfaces cut along their intersection edges, which
// are found a second time from all pairs of triangles.
#include "property.hpp"

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/regions/regions_over.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace terrane::fuzz {

Soup input(Bytes& bytes) {
    return fuzzing::soup(bytes, 24);
}

namespace {

/// A triangle as a part of one surface.
struct Part {
    std::uint32_t triangle, surface;
    std::uint32_t region = 0; ///< found by find_regions
    std::size_t group = 0;    ///< found here
};

/// Returns the common edges of two triangles: all three for a triangle that is a part of two
/// surfaces, and itself.
std::vector<Edge> common_edges(const Triangle& a, const Triangle& b) {
    std::vector<std::uint32_t> shared;
    for (const auto v : a)
        if (std::find(b.begin(), b.end(), v) != b.end()) shared.push_back(v);
    std::sort(shared.begin(), shared.end());
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < shared.size(); ++i)
        for (std::size_t j = i + 1; j < shared.size(); ++j) edges.push_back({shared[i], shared[j]});
    return edges;
}

std::vector<Part> parts_of(const Arrangement& a, const Regions& regions) {
    std::vector<Part> parts;
    for (std::uint32_t t = 0; t < a.triangles.size(); ++t)
        for (std::size_t i = 0; i < a.surfaces_of[t].size(); ++i)
            parts.push_back({t, a.surfaces_of[t][i], regions.regions_of[t][i], parts.size()});
    return parts;
}

void join(std::vector<Part>& parts, std::size_t from, std::size_t to) {
    for (Part& p : parts)
        if (p.group == from) p.group = to;
}

/// Joins parts across edges that are not intersection edges; returns the neighbours of regions
/// across intersection edges.
std::map<std::uint32_t, std::set<std::uint32_t>> spread(const Arrangement& a,
                                                        std::vector<Part>& parts) {
    std::map<std::uint32_t, std::set<std::uint32_t>> neighbours;
    for (const Part& p : parts)
        for (const Part& q : parts)
            for (const Edge& e : common_edges(a.triangles[p.triangle], a.triangles[q.triangle])) {
                const bool cut =
                    std::binary_search(a.intersection_edges.begin(), a.intersection_edges.end(), e);
                if (!cut && p.surface == q.surface && p.group != q.group)
                    join(parts, q.group, p.group);
                if (cut && p.region != q.region) neighbours[p.region].insert(q.region);
            }
    return neighbours;
}

std::string groups_flaw(const std::vector<Part>& parts, const Regions& regions) {
    std::map<std::size_t, std::uint32_t> region_of;
    std::map<std::uint32_t, std::size_t> triangles;
    for (const Part& p : parts) {
        if (p.region >= regions.regions.size()) return "a region that does not exist";
        if (regions.regions[p.region].surface != p.surface) return "a region of another surface";
        if (region_of.try_emplace(p.group, p.region).first->second != p.region)
            return "a region is parted";
        ++triangles[p.region];
    }
    if (region_of.size() != regions.regions.size()) return "two regions are one";
    for (std::uint32_t r = 0; r < regions.regions.size(); ++r)
        if (regions.regions[r].triangles != triangles[r]) return "a region's number of triangles";
    return "";
}

} // namespace

std::string flaw(std::span<const Surface> surfaces) {
    const auto made = arrange(surfaces);
    if (!made) return made.error().message();
    const Arrangement& a = made.value();
    std::vector<Point3> vertices;
    for (const PointIndex p : a.vertices) vertices.push_back(a.state->points.nearest(p));
    const Regions regions = find_regions(vertices, a.triangles, a.surfaces_of, a.state->adjacency,
                                         a.intersection_edges);
    auto parts = parts_of(a, regions);
    auto neighbours = spread(a, parts);
    if (auto what = groups_flaw(parts, regions); !what.empty()) return what;
    for (std::uint32_t r = 0; r < regions.regions.size(); ++r) {
        const auto& said = regions.regions[r].neighbours;
        if (!std::equal(said.begin(), said.end(), neighbours[r].begin(), neighbours[r].end()))
            return "a region's neighbours";
    }
    return "";
}

} // namespace terrane::fuzz
