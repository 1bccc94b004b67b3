// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include <terrane/algorithms/search/methods.hpp>

namespace terrane::search {
namespace {

double centre(const Box& b, unsigned k) {
    return b.low[k] / 2 + b.high[k] / 2;
}

} // namespace

Hierarchy::Hierarchy(std::span<const Box> boxes) {
    stored_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) stored_.push_back({boxes[i], i});
    nodes_.reserve(boxes.size() / 2 + 1);
    if (!boxes.empty()) build(0, static_cast<std::uint32_t>(boxes.size()));
}

void Hierarchy::build(std::uint32_t first, std::uint32_t last) {
    const std::size_t here = nodes_.size();
    Node node{stored_[first].box, first, last, 0};
    std::array<double, 3> low{}, high{};
    for (unsigned k = 0; k < 3; ++k) low[k] = high[k] = centre(node.box, k);
    for (std::uint32_t i = first + 1; i < last; ++i)
        for (unsigned k = 0; k < 3; ++k) {
            const Box& b = stored_[i].box;
            node.box.low[k] = std::min(node.box.low[k], b.low[k]);
            node.box.high[k] = std::max(node.box.high[k], b.high[k]);
            low[k] = std::min(low[k], centre(b, k));
            high[k] = std::max(high[k], centre(b, k));
        }
    nodes_.push_back(node);
    if (last - first <= leaf_size) return;
    unsigned axis = 0;
    for (unsigned k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(stored_.begin() + first, stored_.begin() + middle, stored_.begin() + last,
                     [axis](const Stored& a, const Stored& b) {
                         return centre(a.box, axis) < centre(b.box, axis);
                     });
    build(first, middle);
    nodes_[here].second_child = static_cast<std::uint32_t>(nodes_.size());
    build(middle, last);
}

} // namespace terrane::search
