// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include <terrane/algorithms/search/methods.hpp>

namespace terrane::search {

AbTree::AbTree(std::span<const Box> boxes) {
    nodes_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) nodes_.push_back({boxes[i], i});
    build(0, static_cast<std::uint32_t>(nodes_.size()), 0);
}

void AbTree::build(std::uint32_t first, std::uint32_t last, unsigned level) {
    if (last - first < 2) return;
    const std::uint32_t middle = first + (last - first) / 2;
    const auto key = [level](const Node& n) {
        return level < 3 ? n.box.low[level] : n.box.high[level - 3];
    };
    std::nth_element(nodes_.begin() + first, nodes_.begin() + middle, nodes_.begin() + last,
                     [&](const Node& a, const Node& b) { return key(a) < key(b); });
    build(first, middle, (level + 1) % 6);
    build(middle + 1, last, (level + 1) % 6);
}

} // namespace terrane::search
