// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <tuple>
#include <unordered_map>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/mesh/point_table.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

namespace terrane {
namespace {

/// Returns, for each vertex of the arrangement, the vertex of the mesh at its nearest doubles, or
/// none.
std::vector<std::uint32_t> vertices_in_mesh(const Arrangement& a, const Mesh& mesh) {
    std::unordered_map<Point3, std::uint32_t, PointHash> at;
    at.reserve(mesh.vertices.size());
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) at.emplace(mesh.vertices[v], v);
    std::vector<std::uint32_t> found;
    found.reserve(a.vertices.size());
    for (const PointIndex p : a.vertices) {
        const auto it = at.find(a.state->points.nearest(p));
        found.push_back(it == at.end() ? no_index : it->second);
    }
    return found;
}

/// Rotates a triangle so that its least corner comes first; the winding is kept.
Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

/// A triangle of the mesh: its corners, least first, and its index.
using Named = std::pair<Triangle, std::uint32_t>;

std::vector<Named> by_corners(std::span<const Triangle> triangles) {
    std::vector<Named> named;
    named.reserve(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        named.emplace_back(turned(triangles[t]), t);
    std::sort(named.begin(), named.end());
    return named;
}

/// Returns {volume of the mesh, volume of the arrangement} for each side of the triangles that
/// both have.
std::vector<std::array<std::uint32_t, 2>> common_sides(const Arrangement& a, const Volumes& exact,
                                                       const Mesh& mesh, const Volumes& rounded) {
    const auto vertex = vertices_in_mesh(a, mesh);
    const auto named = by_corners(mesh.triangles);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    const auto add = [&](const Triangle& corners, std::uint32_t t, bool same_winding) {
        const auto it = std::lower_bound(named.begin(), named.end(), Named(turned(corners), 0));
        if (it == named.end() || it->first != turned(corners)) return;
        const auto& here = rounded.of_sides[it->second];
        const auto& there = exact.of_sides[t];
        pairs.push_back({here[0], there[same_winding ? 0 : 1]});
        pairs.push_back({here[1], there[same_winding ? 1 : 0]});
    };
    for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
        const auto [i, j, k] = a.triangles[t];
        const Triangle corners{vertex[i], vertex[j], vertex[k]};
        if (std::find(corners.begin(), corners.end(), no_index) != corners.end()) continue;
        add(corners, t, true);
        add({corners[0], corners[2], corners[1]}, t, false);
    }
    return pairs;
}

} // namespace

std::vector<std::uint32_t> match_volumes(const Arrangement& arrangement, const Volumes& exact,
                                         const Mesh& mesh, const Volumes& rounded) {
    auto pairs = common_sides(arrangement, exact, mesh, rounded);
    std::sort(pairs.begin(), pairs.end());
    struct Overlap {
        std::size_t sides;
        std::uint32_t here, there;
    };
    std::vector<Overlap> overlaps;
    for (std::size_t i = 0, end = 0; i < pairs.size(); i = end) {
        while (end < pairs.size() && pairs[end] == pairs[i]) ++end;
        if (pairs[i][0] != 0 && pairs[i][1] != 0)
            overlaps.push_back({end - i, pairs[i][0], pairs[i][1]});
    }
    std::sort(overlaps.begin(), overlaps.end(), [](const Overlap& a, const Overlap& b) {
        return std::tie(b.sides, a.here, a.there) < std::tie(a.sides, b.here, b.there);
    });
    std::vector<std::uint32_t> match(rounded.measures.size(), no_index);
    std::vector<bool> taken(exact.measures.size(), false);
    match[0] = 0;
    for (const Overlap& o : overlaps) {
        if (match[o.here] != no_index || taken[o.there]) continue;
        match[o.here] = o.there;
        taken[o.there] = true;
    }
    return match;
}

Volumes renumbered(const Volumes& volumes, std::span<const std::uint32_t> match,
                   std::size_t exact) {
    std::vector<std::uint32_t> number(match.begin(), match.end());
    auto next = static_cast<std::uint32_t>(exact);
    for (std::uint32_t& n : number)
        if (n == no_index) n = next++;
    Volumes out = volumes;
    for (auto& sides : out.of_sides) sides = {number[sides[0]], number[sides[1]]};
    out.measures.assign(next, 0);
    for (std::size_t v = 0; v < number.size(); ++v) out.measures[number[v]] = volumes.measures[v];
    return out;
}

} // namespace terrane
