// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/edges.hpp>

#include <algorithm>
#include <utility>

#include <terrane/algorithms/core/invariants.hpp>
#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/kernel/assertion.hpp>

namespace terrane {

namespace {

/// A triangle by its corners in ascending order. Its sides are low-middle, low-high, middle-high, so
/// that two of them have `low` as their smaller vertex.
struct AscendingCorners {
    std::uint32_t low, middle, high;

    explicit AscendingCorners(const Triangle& t) :
        low(std::min({t[0], t[1], t[2]})),
        middle(std::max(std::min(t[0], t[1]), std::min(std::max(t[0], t[1]), t[2]))),
        high(std::max({t[0], t[1], t[2]})) {}
};

/// Tells whether the corners of two triangles are numbered in the same order.
bool have_same_order(const Triangle& t, const Triangle& u) {
    return (t[0] < t[1]) == (u[0] < u[1]) && (t[1] < t[2]) == (u[1] < u[2]) &&
           (t[2] < t[0]) == (u[2] < u[0]);
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
        for (std::size_t t = first; t < last; ++t) {
            const AscendingCorners c(triangles[t]);
            counts[c.low] += 2;
            ++counts[c.middle];
        }
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
        for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
            const AscendingCorners c(triangles[t]);
            const std::uint32_t at = std::exchange(next[c.low], next[c.low] + 2);
            e.sides[at] = {c.middle, t};
            e.sides[at + 1] = {c.high, t};
            e.sides[next[c.middle]++] = {c.high, t};
        }
    });
    for_ranges(vertex_count, run, [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v)
            sort_by_high(std::span(e.sides).subspan(e.starts[v], e.starts[v + 1] - e.starts[v]));
    });
    return e;
}

RenamedTriangles::RenamedTriangles(std::span<const Triangle> old, std::size_t old_vertices,
                                   std::span<const Triangle> triangles,
                                   std::span<const std::uint32_t> old_of) :
    number(old.size(), no_index),
    vertex_now(old_vertices, no_index) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t before = old_of[t];
        const bool is_known = before != no_index && number[before] == no_index &&
                              have_same_order(old[before], triangles[t]);
        if (!is_known) {
            others.push_back(t);
            continue;
        }
        number[before] = t;
        for (unsigned i = 0; i < 3; ++i) vertex_now[old[before][i]] = triangles[t][i];
    }
}

EdgeSides edges_after(const EdgeSides& old, const RenamedTriangles& renamed,
                      std::span<const Triangle> triangles, std::size_t vertex_count,
                      const Run& run) {
    const auto for_old_vertices = [&](const auto& work) {
        for_ranges(old.starts.size() - 1, run, [&](std::size_t first, std::size_t last) {
            for (std::size_t v = first; v < last; ++v)
                if (renamed.vertex_now[v] != no_index)
                    work(renamed.vertex_now[v],
                         std::span(old.sides).subspan(old.starts[v],
                                                      old.starts[v + 1] - old.starts[v]));
        });
    };
    EdgeSides e; // starts has the counts of the vertices first
    e.starts.assign(vertex_count + 1, 0);
    for_old_vertices([&](std::uint32_t v, std::span<const EdgeSides::Side> sides) {
        e.starts[v] = static_cast<std::uint32_t>(std::ranges::count_if(
            sides, [&](const auto& s) { return renamed.number[s.triangle] != no_index; }));
    });
    std::vector<char> is_mixed(vertex_count, 0); // whether another triangle has sides there
    for (const std::uint32_t t : renamed.others) {
        const AscendingCorners c(triangles[t]);
        e.starts[c.low] += 2;
        e.starts[c.middle] += 1;
        is_mixed[c.low] = is_mixed[c.middle] = 1;
    }
    std::uint32_t total = 0;
    for (std::uint32_t& start : e.starts) total += std::exchange(start, total);
    e.sides.resize(total);
    std::vector<std::uint32_t> next = e.starts;
    for (const std::uint32_t t : renamed.others) {
        const AscendingCorners c(triangles[t]);
        e.sides[next[c.low]++] = {c.middle, t};
        e.sides[next[c.low]++] = {c.high, t};
        e.sides[next[c.middle]++] = {c.high, t};
    }
    for_old_vertices([&](std::uint32_t v, std::span<const EdgeSides::Side> sides) {
        std::uint32_t at = next[v];
        for (const EdgeSides::Side& s : sides)
            if (renamed.number[s.triangle] != no_index)
                e.sides[at++] = {renamed.vertex_now[s.high], renamed.number[s.triangle]};
        const auto here = std::span(e.sides).subspan(e.starts[v], at - e.starts[v]);
        if (!std::ranges::is_sorted(here)) std::ranges::sort(here);
        is_mixed[v] = 0;
    });
    for (std::size_t v = 0; v < vertex_count; ++v) // those without a known triangle
        if (is_mixed[v] != 0)
            std::ranges::sort(
                std::span(e.sides).subspan(e.starts[v], e.starts[v + 1] - e.starts[v]));
    return e;
}

} // namespace terrane
