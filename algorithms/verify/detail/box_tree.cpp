// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/box_tree.hpp>

#include <algorithm>

#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

bool touch(const Box& a, const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (a.high[i] < b.low[i] || b.high[i] < a.low[i]) return false;
    }
    return true;
}

void extend(Box& box, const Box& other) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::min(box.low[i], other.low[i]);
        box.high[i] = std::max(box.high[i], other.high[i]);
    }
}

/// Calls take(item) for each item whose box touches a box.
template <class Take>
void BoxTree::for_each_touching(const Box& box, const Take& take) const {
    for (std::size_t n = 0; n < nodes_.size();) {
        look_for_stop();
        const Node& node = nodes_[n];
        if (!touch(node.box, box)) {
            n = node.after;
            continue;
        }
        for (std::size_t i = node.first; i < node.last; ++i)
            if (touch(boxes_[items_[i]], box)) take(items_[i]);
        ++n;
    }
}

std::vector<std::uint32_t> BoxTree::touching(const Box& box) const {
    std::vector<std::uint32_t> found;
    for_each_touching(box, [&](std::uint32_t item) { found.push_back(item); });
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::uint32_t> BoxTree::touching_above(std::uint32_t item) const {
    std::vector<std::uint32_t> found;
    for_each_touching(boxes_[item], [&](std::uint32_t other) {
        if (other > item) found.push_back(other);
    });
    std::sort(found.begin(), found.end());
    return found;
}

void BoxTree::build(std::size_t first, std::size_t last) {
    look_for_stop();
    const std::size_t n = nodes_.size();
    Box box = boxes_[items_[first]];
    for (std::size_t i = first; i < last; ++i) extend(box, boxes_[items_[i]]);
    nodes_.push_back({box, 0, 0, 0});
    if (last - first <= leaf_size) {
        nodes_[n].first = first;
        nodes_[n].last = last;
    } else {
        const std::size_t middle = split(first, last, box);
        build(first, middle);
        build(middle, last);
    }
    nodes_[n].after = nodes_.size();
}

/// Splits the items in half along the longest side of their box. Any split would be correct.
std::size_t BoxTree::split(std::size_t first, std::size_t last, const Box& box) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [this](std::size_t i) {
        return items_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(boxes_[a].low[axis], a) < std::pair(boxes_[b].low[axis], b);
    });
    return middle;
}

} // namespace terrane::verifier
