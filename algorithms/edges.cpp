// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/edges.hpp>

#include <algorithm>

#include <terrane/algorithms/parallel.hpp>

namespace terrane {

EdgeSides group_edges(std::span<const Triangle> triangles, std::size_t vertex_count,
                      const Run& run) {
    EdgeSides e;
    e.starts.assign(vertex_count + 2, 0);
    // Each range of lower vertices looks at all triangles.
    const auto for_edges = [&](std::size_t first, std::size_t last, const auto& visit) {
        const auto side = [&](std::uint32_t v, std::uint32_t w, std::uint32_t t) {
            const std::uint32_t low = std::min(v, w);
            if (low >= first && low < last) visit(low, std::max(v, w), t);
        };
        for (std::uint32_t t = 0; t < triangles.size(); ++t) {
            const auto [a, b, c] = triangles[t];
            side(a, b, t);
            side(b, c, t);
            side(c, a, t);
        }
    };
    // Counted two places ahead, so that filling moves each start to where it belongs.
    for_ranges(
        vertex_count, run,
        [&](std::size_t first, std::size_t last) {
            for_edges(first, last, [&](std::uint32_t low, std::uint32_t, std::uint32_t) {
                ++e.starts[low + 2];
            });
        },
        1);
    for (std::size_t v = 2; v < e.starts.size(); ++v) e.starts[v] += e.starts[v - 1];
    e.sides.resize(3 * triangles.size());
    for_ranges(
        vertex_count, run,
        [&](std::size_t first, std::size_t last) {
            for_edges(first, last, [&](std::uint32_t low, std::uint32_t high, std::uint32_t t) {
                e.sides[e.starts[low + 1]++] = {high, t};
            });
        },
        1);
    e.starts.pop_back();
    for_ranges(vertex_count, run, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v)
            std::sort(e.sides.begin() + e.starts[v], e.sides.begin() + e.starts[v + 1]);
    });
    return e;
}

} // namespace terrane
