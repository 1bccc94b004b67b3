// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace terrane {

/// Makes a binary tree over items, of which `order` has the numbers. A node with more than `most` items
/// is split at the median along the axis on which their middles spread most; `order` becomes that of
/// the leaves. middle(item) returns three coordinates; node(first, last) a node of items of `order`, in
/// whose member `children` the number of the first of two children is put. Cost: O(n log n).
template <class Node, class Middle, class MakeNode>
void build_median_tree(std::vector<std::uint32_t>& order, std::vector<Node>& nodes,
                       std::uint32_t most, const Middle& middle, const MakeNode& node) {
    if (!order.empty()) nodes.push_back(node(0, static_cast<std::uint32_t>(order.size())));
    for (std::size_t n = 0; n < nodes.size(); ++n) { // nodes are added on the way
        const std::uint32_t first = nodes[n].first, last = nodes[n].last;
        if (last - first <= most) continue;
        std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, spread{};
        std::array<double, 3> high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (std::uint32_t i = first; i < last; ++i) {
            const std::array<double, 3> at = middle(order[i]);
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], at[k]);
                high[k] = std::max(high[k], at[k]);
            }
        }
        for (std::size_t k = 0; k < 3; ++k) spread[k] = high[k] - low[k];
        const auto longest =
            static_cast<std::size_t>(std::ranges::max_element(spread) - spread.begin());
        const auto key = [&](std::uint32_t t) { return std::pair(middle(t)[longest], t); };
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(order.begin() + first, order.begin() + half, order.begin() + last,
                         [&](std::uint32_t s, std::uint32_t t) { return key(s) < key(t); });
        nodes[n].children = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node(first, half));
        nodes.push_back(node(half, last));
    }
}

} // namespace terrane
