// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/plausibility/detail/left_extents.hpp>

#include <algorithm>
#include <cmath>

namespace terrane::plausibility::detail {
namespace {

constexpr std::uint32_t most_in_a_leaf = 4;

/// Returns the power of two of a diagonal; a class of its own for 0.
int size_class(const Extent& extent) {
    return std::ilogb(extent.diagonal());
}

} // namespace

LeftExtents::LeftExtents(std::span<const Extent> extents, std::span<const std::uint32_t> numbers) :
    extents_(extents), order_(numbers.begin(), numbers.end()), left_(extents.size()) {
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t s) { return size_class(extents_[s]); });
    for (std::uint32_t first = 0, last = 0; first < order_.size(); first = last) {
        const int size = size_class(extents_[order_[first]]);
        while (last < order_.size() && size_class(extents_[order_[last]]) == size) ++last;
        roots_.push_back(static_cast<std::uint32_t>(nodes_.size()));
        nodes_.push_back({{}, 0, first, last});
        build(roots_.back());
    }
    for (const std::uint32_t s : numbers) left_[s] = true;
    for (std::size_t n = nodes_.size(); n-- > 0;) gather(nodes_[n]); // children come behind parents
}

/// Splits a node at the median of the axis along which the middles of its extents spread most.
void LeftExtents::build(std::uint32_t node) {
    for (std::uint32_t next = node; next < nodes_.size(); ++next) {
        const auto [first, last] = std::pair(nodes_[next].first, nodes_[next].last);
        if (last - first <= most_in_a_leaf) continue;
        Extent middles;
        for (std::uint32_t i = first; i < last; ++i) {
            const Extent& e = extents_[order_[i]];
            middles.add(Point3{e.middle(0), e.middle(1), 0});
        }
        const std::size_t axis = middles.size(0) >= middles.size(1) ? 0 : 1;
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                         [&](std::uint32_t s, std::uint32_t r) {
                             return extents_[s].middle(axis) < extents_[r].middle(axis);
                         });
        nodes_[next].children = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({{}, 0, first, half});
        nodes_.push_back({{}, 0, half, last});
    }
}

/// Sums up what is left in a node.
void LeftExtents::gather(Node& node) const {
    node.all = {};
    node.diagonal = 0;
    if (node.children > 0) {
        for (const std::uint32_t c : {node.children, node.children + 1}) {
            node.all.add(nodes_[c].all);
            node.diagonal = std::max(node.diagonal, nodes_[c].diagonal);
        }
        return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
        if (!left_[order_[i]]) continue;
        node.all.add(extents_[order_[i]]);
        node.diagonal = std::max(node.diagonal, extents_[order_[i]].diagonal());
    }
}

void LeftExtents::take_near(const Extent& here, double far, std::vector<std::uint32_t>& taken) {
    for (const std::uint32_t root : roots_) take(root, here, far, taken);
}

void LeftExtents::take(std::uint32_t at, const Extent& here, double far,
                       std::vector<std::uint32_t>& taken) {
    ++visits_;
    Node& node = nodes_[at];
    // A gap is no shorter than along an axis, and no extent in the node has a smaller one there, rounded or not.
    if (node.empty() || std::ranges::max(gaps_from_above(here, node.all)) >
                            far * std::max(here.diagonal(), node.diagonal))
        return;
    if (node.children > 0) {
        for (const std::uint32_t c : {node.children, node.children + 1}) take(c, here, far, taken);
    } else {
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            const std::uint32_t s = order_[i];
            if (!left_[s] || !are_near(here, extents_[s], far)) continue;
            left_[s] = false;
            taken.push_back(s);
        }
    }
    gather(node);
}

} // namespace terrane::plausibility::detail
