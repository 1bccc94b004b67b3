// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The sides of triangles, and the triangles at edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/mesh/surface.hpp>
#include <terrane/algorithms/verify/detail/violations.hpp>

namespace terrane::verifier {

/// A side of a triangle.
struct HalfEdge {
    Edge edge{}; ///< the lower vertex first
    std::uint32_t triangle = 0;
    bool ascends = false;   ///< the triangle passes it from the lower to the higher vertex
    std::uint32_t apex = 0; ///< the other corner

    friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

/// Returns the sides of a triangle, from each corner to the next.
std::array<HalfEdge, 3> sides_of(const Triangle& triangle, std::uint32_t number = 0);

/// Returns the sides of all triangles, sorted by edges, then by triangles.
std::vector<HalfEdge> half_edges(std::span<const Triangle> triangles);

/// Calls visit(sides) for the sides at each edge. They are sorted.
template <class Visit>
void for_each_edge(std::span<const HalfEdge> sides, const Visit& visit) {
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
        visit(sides.subspan(first, last - first));
    }
}

/// The triangles at each edge, ascending.
using EdgeTriangles = std::map<Edge, Numbers>;
EdgeTriangles triangles_at_edges(std::span<const Triangle> triangles);

/// Returns a triangle with its least corner first, wound as before.
Triangle with_least_first(Triangle triangle);

/// The corners of a triangle in ascending order, and whether they are counterclockwise in that order.
struct SortedCorners {
    Triangle corners{};
    bool even = true;

    friend auto operator<=>(const SortedCorners&, const SortedCorners&) = default;
};
SortedCorners sorted_corners(const Triangle& triangle);

} // namespace terrane::verifier
