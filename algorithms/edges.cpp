// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/edges.hpp>

#include <algorithm>
#include <tuple>

namespace terrane {

EdgeSides group_edges(std::span<const Triangle> triangles, std::size_t vertex_count) {
    EdgeSides e;
    e.starts.assign(vertex_count + 1, 0);
    const auto low = [](const Triangle& t, unsigned i) { return std::min(t[i], t[(i + 1) % 3]); };
    const auto high = [](const Triangle& t, unsigned i) { return std::max(t[i], t[(i + 1) % 3]); };
    for (const Triangle& t : triangles)
        for (unsigned i = 0; i < 3; ++i) ++e.starts[low(t, i) + 1];
    for (std::size_t v = 1; v < e.starts.size(); ++v) e.starts[v] += e.starts[v - 1];
    e.sides.resize(3 * triangles.size());
    auto next = e.starts;
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (unsigned i = 0; i < 3; ++i)
            e.sides[next[low(triangles[t], i)]++] = {high(triangles[t], i), t, i};
    for (std::size_t v = 0; v + 1 < e.starts.size(); ++v)
        std::sort(e.sides.begin() + e.starts[v], e.sides.begin() + e.starts[v + 1],
                  [](const auto& a, const auto& b) {
                      return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
                  });
    return e;
}

} // namespace terrane
