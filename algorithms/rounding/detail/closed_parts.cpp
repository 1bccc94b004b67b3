// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/closed_parts.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

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

} // namespace

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
