// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/edges.hpp>

#include <algorithm>

namespace terrane::verifier {

std::array<HalfEdge, 3> sides_of(const Triangle& triangle, std::uint32_t number) {
    std::array<HalfEdge, 3> sides;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
        sides[i] = {
            {std::min(from, to), std::max(from, to)}, number, from < to, triangle[(i + 2) % 3]};
    }
    return sides;
}

std::vector<HalfEdge> half_edges(std::span<const Triangle> triangles) {
    std::vector<HalfEdge> all;
    all.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto sides = sides_of(triangles[t], t);
        all.insert(all.end(), sides.begin(), sides.end());
    }
    std::ranges::sort(all);
    return all;
}

EdgeTriangles triangles_at_edges(std::span<const Triangle> triangles) {
    EdgeTriangles result;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (const HalfEdge& side : sides_of(triangles[t])) result[side.edge].push_back(t);
    return result;
}

Triangle with_least_first(Triangle triangle) {
    std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
    return triangle;
}

SortedCorners sorted_corners(const Triangle& triangle) {
    const auto [a, b, c] = with_least_first(triangle);
    if (b <= c) return {{a, b, c}, true};
    return {{a, c, b}, false};
}

} // namespace terrane::verifier
