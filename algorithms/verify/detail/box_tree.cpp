// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/box_tree.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

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

Box widened_by(Box box, double distance) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::nextafter(box.low[i] - distance, -infinity);
        box.high[i] = std::nextafter(box.high[i] + distance, infinity);
    }
    return box;
}

Box box_of(const Point3& point) {
    return {{point.x, point.y, point.z}, {point.x, point.y, point.z}};
}

Box box_of(std::span<const Point3> points, const Triangle& triangle) {
    Box box = box_of(points[triangle[0]]);
    for (const std::uint32_t corner : triangle) extend(box, box_of(points[corner]));
    return box;
}

Box box_of(std::span<const Vector4> points, const Triangle& triangle) {
    Box box = enclose(points[triangle[0]], 1);
    for (const std::size_t i : {1U, 2U}) extend(box, enclose(points[triangle[i]], 1));
    return box;
}

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), items_(boxes_.size()) {
    std::iota(items_.begin(), items_.end(), 0U);
    if (!items_.empty()) build(0, items_.size());
}

BoxTree::BoxTree(std::vector<Box> boxes, std::vector<std::uint32_t> items,
                 std::vector<std::uint32_t> groups) :
    boxes_(std::move(boxes)),
    items_(std::move(items)), groups_(std::move(groups)) {
    if (!groups_.empty())
        std::ranges::stable_sort(items_, {}, [&](std::uint32_t item) { return groups_[item]; });
    if (!items_.empty()) build(0, items_.size());
}

std::uint32_t BoxTree::group_of(std::size_t position) const {
    return groups_.empty() ? no_number : groups_[items_[position]];
}

std::vector<std::uint32_t> BoxTree::touching(const Box& box, std::uint32_t but) const {
    std::vector<std::uint32_t> found;
    for (std::size_t n = 0; n < nodes_.size();) {
        look_for_stop();
        const Node& node = nodes_[n];
        if ((node.group == but && but != no_number) || !touch(node.box, box)) {
            n = node.after;
            continue;
        }
        for (std::size_t i = node.first; i < node.last; ++i)
            if (touch(boxes_[items_[i]], box)) found.push_back(items_[i]);
        ++n;
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<std::uint32_t> BoxTree::touching_others(std::uint32_t item) const {
    return touching(boxes_[item], groups_.empty() ? no_number : groups_[item]);
}

void BoxTree::build(std::size_t first, std::size_t last) {
    look_for_stop();
    const std::size_t n = nodes_.size();
    Box box = boxes_[items_[first]];
    for (std::size_t i = first; i < last; ++i) extend(box, boxes_[items_[i]]);
    const bool is_one_group = group_of(first) == group_of(last - 1);
    nodes_.push_back({box, 0, 0, 0, is_one_group ? group_of(first) : no_number});
    if (is_one_group && last - first <= leaf_size) {
        nodes_[n].first = first;
        nodes_[n].last = last;
    } else {
        const std::size_t middle = split(first, last, box);
        build(first, middle);
        build(middle, last);
    }
    nodes_[n].after = nodes_.size();
}

/// Splits the items between two groups, or in half along the longest side of their box.
std::size_t BoxTree::split(std::size_t first, std::size_t last, const Box& box) {
    const std::size_t half = first + (last - first) / 2;
    if (group_of(first) != group_of(last - 1)) {
        std::size_t middle = half;
        while (middle > first && group_of(middle - 1) == group_of(half)) --middle;
        while (middle == first || group_of(middle - 1) == group_of(middle)) ++middle;
        return middle;
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
    }
    const auto at = [this](std::size_t i) {
        return items_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(half), at(last), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(boxes_[a].low[axis], a) < std::pair(boxes_[b].low[axis], b);
    });
    return half;
}

} // namespace terrane::verifier
