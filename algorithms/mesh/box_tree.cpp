// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/box_tree.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t most_boxes_in_leaf = 4;

} // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    for (std::uint32_t b = 0; b < boxes_.size(); ++b)
        if (boxes_[b].low.x <= boxes_[b].high.x) order_.push_back(b);
    if (order_.empty()) return;
    add_node(0, static_cast<std::uint32_t>(order_.size()));
    for (std::size_t n = 0; n < nodes_.size(); ++n) { // nodes are added on the way
        const std::uint32_t first = nodes_[n].first, last = nodes_[n].last;
        if (last - first <= most_boxes_in_leaf) continue;
        const Point3 size = minus(nodes_[n].box.high, nodes_[n].box.low);
        const auto longest = size.x >= size.y && size.x >= size.z ? &Point3::x
                             : size.y >= size.z                   ? &Point3::y
                                                                  : &Point3::z;
        const auto key = [&](std::uint32_t b) {
            return std::pair(boxes_[b].low.*longest + boxes_[b].high.*longest, b);
        };
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        nodes_[n].children = static_cast<std::uint32_t>(nodes_.size());
        add_node(first, half);
        add_node(half, last);
    }
}

void BoxTree::add_node(std::uint32_t first, std::uint32_t last) {
    Box all = boxes_[order_[first]];
    for (std::uint32_t i = first; i < last; ++i) {
        const auto& [low, high] = boxes_[order_[i]];
        all.low = {std::min(all.low.x, low.x), std::min(all.low.y, low.y),
                   std::min(all.low.z, low.z)};
        all.high = {std::max(all.high.x, high.x), std::max(all.high.y, high.y),
                    std::max(all.high.z, high.z)};
    }
    nodes_.push_back({all, first, last});
}

std::vector<std::uint32_t> BoxTree::within(const Point3& p, double bound) const {
    std::vector<std::uint32_t> found, open;
    if (!nodes_.empty()) open.push_back(0);
    const auto is_near = [&](const Box& box) {
        return distance_to_box(p, box.low, box.high) < bound;
    };
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (!is_near(node.box)) continue;
        if (node.children > 0) {
            open.insert(open.end(), {node.children, node.children + 1});
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i)
            if (is_near(boxes_[order_[i]])) found.push_back(order_[i]);
    }
    std::ranges::sort(found);
    return found;
}

} // namespace terrane
