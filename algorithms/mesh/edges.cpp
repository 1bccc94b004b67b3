// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/edges.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/invariants.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane {

namespace {

/// Calls visit(low, high, triangle) for the sides of the triangles [first, last).
template <class Visit>
void for_sides(std::span<const Triangle> triangles, std::size_t first, std::size_t last,
               const Visit& visit) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
        const auto [a, b, c] = triangles[t];
        visit(std::min(a, b), std::max(a, b), t);
        visit(std::min(b, c), std::max(b, c), t);
        visit(std::min(c, a), std::max(c, a), t);
    }
}

/// Sorts sides by their larger vertex; they are given in the order of the triangles.
void sort_by_high(std::span<EdgeSides::Side> sides) {
    constexpr std::size_t few = 24;
    if (sides.size() > few) return std::sort(sides.begin(), sides.end());
    for (std::size_t k = 1; k < sides.size(); ++k) {
        const EdgeSides::Side s = sides[k];
        std::size_t to = k;
        for (; to > 0 && s.high < sides[to - 1].high; --to) sides[to] = sides[to - 1];
        sides[to] = s;
    }
}

} // namespace

EdgeSides group_edges(std::span<const Triangle> triangles, std::size_t vertex_count,
                      const Run& run) {
    TERRANE_ASSERT_PARANOID(corners_below(triangles, vertex_count));
    // This is a counting sort. Each share of the triangles has its own counts, which become the
    // positions of its sides, after those of the shares before it. The number of shares is limited
    // because their counts take memory.
    constexpr std::size_t least = least_range, most_shares = 8; // triangles in a share; shares
    const std::size_t shares = std::clamp<std::size_t>(
        triangles.size() / least, 1, std::min<std::size_t>(std::max(run.threads, 1U), most_shares));
    std::vector<std::vector<std::uint32_t>> places(shares);
    const auto for_shares = [&](const auto& work) {
        for_ranges(
            shares, run,
            [&](std::size_t first, std::size_t last) {
                for (std::size_t s = first; s < last; ++s)
                    work(places[s], triangles.size() * s / shares,
                         triangles.size() * (s + 1) / shares);
            },
            1, 1);
    };
    for_shares([&](auto& counts, std::size_t first, std::size_t last) {
        counts.assign(vertex_count, 0);
        for_sides(triangles, first, last,
                  [&](std::uint32_t low, std::uint32_t, std::uint32_t) { ++counts[low]; });
    });
    EdgeSides e;
    e.starts.resize(vertex_count + 1);
    std::uint32_t total = 0;
    for (std::size_t v = 0; v < vertex_count; ++v) {
        e.starts[v] = total;
        for (auto& counts : places) total += std::exchange(counts[v], total);
    }
    e.starts[vertex_count] = total;
    e.sides.resize(total);
    for_shares([&](auto& next, std::size_t first, std::size_t last) {
        for_sides(triangles, first, last,
                  [&](std::uint32_t low, std::uint32_t high, std::uint32_t t) {
                      e.sides[next[low]++] = {high, t};
                  });
    });
    for_ranges(vertex_count, run, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v)
            sort_by_high(std::span(e.sides).subspan(e.starts[v], e.starts[v + 1] - e.starts[v]));
    });
    return e;
}

} // namespace terrane
