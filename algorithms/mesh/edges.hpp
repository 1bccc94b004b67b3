// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/algorithms/core/uninitialized_vector.hpp>
#include <terrane/algorithms/mesh/mesh.hpp>

namespace terrane {

/// The sides of all triangles, grouped by edge.
struct EdgeSides {
    struct Side {
        std::uint32_t high; ///< larger vertex of the edge
        std::uint32_t triangle;

        friend auto operator<=>(const Side&, const Side&) = default;
    };
    std::vector<std::uint32_t>
        starts; ///< per vertex: index of its first side, as smaller vertex; then the total
    UninitializedVector<Side> sides; ///< sorted by smaller vertex, larger vertex, and triangle

    /// Calls visit(low, high, sides of this edge) for each edge, ascending.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for_each(0, starts.size() - 1, visit);
    }

    /// Calls visit(low, high, sides of this edge) for each edge with low in [first, last),
    /// ascending.
    template <class Visit>
    void for_each(std::size_t first, std::size_t last, const Visit& visit) const {
        for (auto low = static_cast<std::uint32_t>(first); low < last; ++low)
            for (std::uint32_t i = starts[low]; i < starts[low + 1];) {
                std::uint32_t end = i + 1;
                while (end < starts[low + 1] && sides[end].high == sides[i].high) ++end;
                visit(low, sides[i].high, std::span(sides).subspan(i, end - i));
                i = end;
            }
    }
};

/// Tells whether the corners of a triangle, which has this edge, run from `from` to `to`.
inline bool runs_along(const Triangle& t, std::uint32_t from, std::uint32_t to) {
    return t[0] == from ? t[1] == to : t[1] == from ? t[2] == to : t[0] == to;
}

/// Groups the sides of all triangles by edge. The three corners of a triangle must differ.
/// Cost: linear (a counting sort by the smaller vertex).
EdgeSides group_edges(std::span<const Triangle> triangles, std::size_t vertex_count,
                      const Run& run = {});

/// Triangles of an old mesh that a mesh still has, with the same corners in the same order, by other
/// numbers. All triangles without an old one are the others; so are those whose corners are
/// numbered in another order than before, as the vertices of their sides are then lower or higher
/// than before.
struct RenamedTriangles {
    std::vector<std::uint32_t>
        number; ///< per old triangle: its number now (the first), or no_index
    std::vector<std::uint32_t> vertex_now; ///< per old vertex of these: its number, or no_index
    std::vector<std::uint32_t> others;     ///< ascending

    /// old_of: per triangle: the old one with these corners, or no_index. A vertex must be the same
    /// old one in all of these triangles, and no two the same.
    RenamedTriangles(std::span<const Triangle> old, std::size_t old_vertices,
                     std::span<const Triangle> triangles, std::span<const std::uint32_t> old_of);
};

/// Returns what group_edges() finds. `old`: the edges of the old mesh. Cost: a pass over the old edges,
/// without sorting where no other triangle is, and a counting sort of the others.
EdgeSides edges_after(const EdgeSides& old, const RenamedTriangles& renamed,
                      std::span<const Triangle> triangles, std::size_t vertex_count,
                      const Run& run = {});

} // namespace terrane
