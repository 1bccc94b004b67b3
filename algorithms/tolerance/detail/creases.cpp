// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tolerance/detail/creases.hpp>

#include <terrane/algorithms/tolerance/detail/tuning.hpp>

namespace terrane::tolerance::detail {
namespace {

bool is_crease(const Surface& s, const std::vector<SurfaceEdge::Side>& sides) {
    if (sides.size() != 2) return true;
    const double cosine = dot(normal_of(s, sides[0].triangle), normal_of(s, sides[1].triangle));
    return (sides[0].forward != sides[1].forward ? cosine : -cosine) < tuning.crease_cosine;
}

} // namespace

Point3 normal_of(const Surface& s, std::uint32_t triangle) {
    const auto& [a, b, c] = s.triangles[triangle];
    return unit(cross(minus(s.vertices[b], s.vertices[a]), minus(s.vertices[c], s.vertices[a])));
}

std::vector<SurfaceEdge> edges_of(const Surface& s) {
    std::vector<std::pair<EdgeEnds, SurfaceEdge::Side>> sides;
    sides.reserve(3 * s.triangles.size());
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k) {
            const Point3 &p = s.vertices[s.triangles[t][k]],
                         &q = s.vertices[s.triangles[t][(k + 1) % 3]];
            if (p != q) sides.push_back({ends_of(p, q), {t, k, p < q}});
        }
    std::ranges::stable_sort(sides, {}, [](const auto& side) { return side.first; });
    std::vector<SurfaceEdge> edges;
    for (const auto& [ends, side] : sides) {
        if (edges.empty() || edges.back().ends != ends) edges.push_back({ends});
        edges.back().sides.push_back(side);
    }
    for (SurfaceEdge& e : edges) e.is_crease = is_crease(s, e.sides);
    return edges;
}

} // namespace terrane::tolerance::detail
