// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <terrane/algorithms/mesh.hpp>

namespace terrane {

/// The sides of all triangles, grouped by edge.
struct EdgeSides {
    struct Side {
        std::uint32_t high; ///< larger vertex of the edge
        std::uint32_t triangle;
        std::uint32_t corner; ///< the edge runs from this corner to the next one
    };
    std::vector<std::uint32_t>
        starts;              ///< per vertex, and the total: sides whose smaller vertex it is
    std::vector<Side> sides; ///< by smaller vertex, then larger vertex, then triangle

    /// Calls visit(low, high, sides of this edge) for each edge, ascending.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (std::uint32_t low = 0; low + 1 < starts.size(); ++low)
            for (std::uint32_t i = starts[low]; i < starts[low + 1];) {
                std::uint32_t end = i + 1;
                while (end < starts[low + 1] && sides[end].high == sides[i].high) ++end;
                visit(low, sides[i].high, std::span(sides).subspan(i, end - i));
                i = end;
            }
    }
};

/// Cost: linear (a counting sort by the smaller vertex). No corner may repeat within a triangle.
EdgeSides group_edges(std::span<const Triangle> triangles, std::size_t vertex_count);

} // namespace terrane
