// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/closed_parts.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <iterator>
#include <map>
#include <set>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/rounding/detail/collapsed_triangles.hpp>

namespace terrane::rounding::detail {
namespace {

/// Returns the parts that are left when those with a free edge are taken away one by one.
std::set<std::uint32_t> without_free_edges(std::span<const Triangle> triangles,
                                           std::span<const std::uint32_t> parts) {
    std::map<Side, std::vector<std::uint32_t>> at;
    for (const std::uint32_t t : parts)
        for (unsigned i = 0; i < 3; ++i) at[side_of(triangles[t], i)].push_back(t);
    std::set<std::uint32_t> left(parts.begin(), parts.end());
    std::vector<std::uint32_t> free;
    for (const auto& [side, around] : at)
        if (around.size() == 1) free.push_back(around[0]);
    while (!free.empty()) {
        const std::uint32_t t = free.back();
        free.pop_back();
        if (left.erase(t) == 0) continue;
        for (unsigned i = 0; i < 3; ++i) {
            auto& around = at[side_of(triangles[t], i)];
            std::erase(around, t);
            if (around.size() == 1) free.push_back(around[0]);
        }
    }
    return left;
}

/// Returns pairs of input triangles with a common side that have an edge in common which is not free in
/// both.
std::set<Side> overlapping_neighbours(const EdgeSides& edges,
                                      const IndexLists<std::uint32_t>& parents_of,
                                      std::span<const Triangle> corners) {
    struct WithSide {
        Side side;
        std::uint32_t parent;
        std::size_t count; ///< of triangles at the edge with this parent
        auto operator<=>(const WithSide&) const = default;
    };
    std::set<Side> pairs;
    std::vector<std::uint32_t> parents;
    std::vector<WithSide> with;
    edges.for_each([&](std::uint32_t, std::uint32_t, std::span<const EdgeSides::Side> sides) {
        if (sides.size() < 3) return;
        parents.clear();
        for (const auto& side : sides)
            for (const std::uint32_t p : parents_of[side.triangle]) parents.push_back(p);
        std::sort(parents.begin(), parents.end());
        with.clear();
        for (std::size_t k = 0, end = 0; k < parents.size(); k = end) {
            while (end < parents.size() && parents[end] == parents[k]) ++end;
            for (unsigned i = 0; i < 3; ++i)
                with.push_back({side_of(corners[parents[k]], i), parents[k], end - k});
        }
        std::sort(with.begin(), with.end());
        for (auto p = with.begin(); p != with.end(); ++p)
            for (auto q = p; q != with.begin() && (--q)->side == p->side;)
                if (p->count + q->count > 2) pairs.insert({q->parent, p->parent});
    });
    return pairs;
}

/// A vertex {a, a, a}, an edge {a, b, b} or a triangle, and an input triangle that it is in.
struct Element {
    std::array<std::uint32_t, 3> corners{};
    std::uint32_t parent = 0;

    friend auto operator<=>(const Element&, const Element&) = default;
    /// Returns its share of the Euler characteristic.
    [[nodiscard]] int sign() const {
        return corners[0] != corners[1] && corners[1] == corners[2] ? -1 : 1;
    }
};

std::vector<Element> elements_of(std::span<const Triangle> triangles,
                                 const IndexLists<std::uint32_t>& parents_of) {
    std::vector<Element> all;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        auto c = triangles[t];
        std::sort(c.begin(), c.end());
        for (const std::uint32_t p : parents_of[t]) {
            all.push_back({c, p});
            for (unsigned i = 0; i < 3; ++i) {
                const auto [a, b] = side_of(c, i);
                all.push_back({{a, b, b}, p});
                all.push_back({{a, a, a}, p});
            }
            all.push_back({{c[2], c[2], c[2]}, p});
        }
    }
    sort_unique(all);
    return all;
}

/// Returns the corners of elements that are in other input triangles before than after.
std::set<std::array<std::uint32_t, 3>> changed_elements(std::span<const Element> before,
                                                        std::span<const Element> after) {
    std::vector<Element> changed;
    std::ranges::set_symmetric_difference(before, after, std::back_inserter(changed));
    std::set<std::array<std::uint32_t, 3>> all;
    for (const Element& e : changed) all.insert(e.corners);
    return all;
}

/// Returns the input triangles with a common side of each one.
std::map<std::uint32_t, std::set<std::uint32_t>>
neighbours_of(const std::map<std::uint32_t, Triangle>& corners) {
    std::map<Side, std::vector<std::uint32_t>> with;
    for (const auto& [p, c] : corners)
        for (unsigned i = 0; i < 3; ++i) with[side_of(c, i)].push_back(p);
    std::map<std::uint32_t, std::set<std::uint32_t>> all;
    for (const auto& [side, around] : with)
        for (const std::uint32_t p : around) all[p].insert(around.begin(), around.end());
    return all;
}

/// Returns the Euler characteristic of what two sets of triangles have in common.
int common_characteristic(std::span<const Triangle> triangles, std::span<const std::uint32_t> one,
                          std::span<const std::uint32_t> other) {
    std::map<Side, unsigned> vertices, edges; // 1: of one, 2: of the other, 3: of both
    std::map<std::uint32_t, unsigned> faces;
    for (const unsigned of : {1U, 2U})
        for (const std::uint32_t t : of == 1 ? one : other) {
            faces[t] |= of;
            for (unsigned i = 0; i < 3; ++i) {
                edges[side_of(triangles[t], i)] |= of;
                vertices[{triangles[t][i], 0}] |= of;
            }
        }
    const auto count = [](const auto& all) {
        return static_cast<int>(
            std::ranges::count_if(all, [](const auto& entry) { return entry.second == 3; }));
    };
    return count(vertices) - count(edges) + count(faces);
}

} // namespace

IndexLists<std::uint32_t> parts_of_inputs(const IndexLists<std::uint32_t>& parents_of) {
    std::vector<std::uint32_t> part_of; // per parent of each triangle
    std::uint32_t inputs = 0;
    for (std::uint32_t t = 0; t < parents_of.size(); ++t)
        for (const std::uint32_t p : parents_of[t]) {
            part_of.push_back(t);
            inputs = std::max(inputs, p + 1);
        }
    return lists_by_key<std::uint32_t>(inputs, parents_of.values,
                                       [&](std::size_t i) { return part_of[i]; });
}

/// What two triangles with a common side have in common is convex before, so that its Euler
/// characteristic is 1.
std::vector<Side> ill_joined(std::span<const Triangle> triangles,
                             const IndexLists<std::uint32_t>& parents_of,
                             std::span<const Triangle> corners) {
    std::uint32_t vertices = 0;
    for (const Triangle& t : triangles)
        vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    const EdgeSides edges = group_edges(triangles, vertices);
    std::vector<Side> found;
    const auto pairs = overlapping_neighbours(edges, parents_of, corners);
    if (pairs.empty()) return found;
    const auto parts = parts_of_inputs(parents_of);
    for (const Side& pair : pairs)
        if (common_characteristic(triangles, parts[pair[0]], parts[pair[1]]) != 1)
            found.push_back(pair);
    return found;
}

/// Only elements that change count for the difference of two Euler characteristics.
bool may_change_joints(std::span<const Triangle> before,
                       const IndexLists<std::uint32_t>& parents_before,
                       std::span<const Triangle> after,
                       const IndexLists<std::uint32_t>& parents_after,
                       const std::map<std::uint32_t, Triangle>& corners) {
    const std::array elements{elements_of(before, parents_before),
                              elements_of(after, parents_after)};
    const auto changed = changed_elements(elements[0], elements[1]);
    const auto neighbours = neighbours_of(corners);
    std::map<Side, int> difference; // per pair of neighbours
    for (const int times : {-1, 1}) {
        const auto& all = elements[times < 0 ? 0 : 1];
        for (std::size_t k = 0, end = 0; k < all.size(); k = end) {
            std::set<std::uint32_t> parents;
            for (; end < all.size() && all[end].corners == all[k].corners; ++end)
                parents.insert(all[end].parent);
            if (!changed.contains(all[k].corners)) continue;
            for (const std::uint32_t p : parents)
                for (const std::uint32_t q : neighbours.at(p))
                    if (p < q && parents.contains(q)) difference[{p, q}] += times * all[k].sign();
        }
    }
    return std::ranges::any_of(difference, [](const auto& d) { return d.second != 0; });
}

/// Reduces the boundary of each part, modulo 2, by those of earlier ones with the same last edge. What
/// is left of none is a sum of them: the part closes a surface.
std::vector<std::uint32_t> superfluous_parts(std::span<const Triangle> triangles,
                                             const IndexLists<std::uint32_t>& parents_of,
                                             std::span<const std::uint32_t> parts) {
    const auto closed = without_free_edges(triangles, parts);
    std::vector<std::uint32_t> left(closed.begin(), closed.end());
    std::stable_sort(left.begin(), left.end(), [&](std::uint32_t t, std::uint32_t u) {
        return parents_of[t].size() > parents_of[u].size();
    });
    std::map<Side, std::vector<Side>> reduced; // by last edge
    std::vector<std::uint32_t> superfluous;
    for (const std::uint32_t t : left) {
        std::vector<Side> boundary, sum;
        for (unsigned i = 0; i < 3; ++i) boundary.push_back(side_of(triangles[t], i));
        std::sort(boundary.begin(), boundary.end());
        while (!boundary.empty()) {
            const auto [known, is_new] = reduced.try_emplace(boundary.back(), boundary);
            if (is_new) break;
            sum.clear();
            std::ranges::set_symmetric_difference(boundary, known->second, std::back_inserter(sum));
            boundary.swap(sum);
        }
        if (boundary.empty()) superfluous.push_back(t);
    }
    return superfluous;
}

} // namespace terrane::rounding::detail
