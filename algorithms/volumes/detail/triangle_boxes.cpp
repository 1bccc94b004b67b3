// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/detail/triangle_boxes.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace terrane::volumes {
namespace {

constexpr std::uint32_t most_triangles_in_leaf = 8;

void add_to(Enclosure& box, const Enclosure& other) {
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::min(box.low[i], other.low[i]);
        box.high[i] = std::max(box.high[i], other.high[i]);
    }
}

} // namespace

TriangleBoxes::TriangleBoxes(const TriangleComplex& sheets, std::uint32_t count) :
    boxes_(count), order_(count) {
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::uint32_t t = 0; t < count; ++t) {
        const auto& [a, b, c] = sheets.triangles[t];
        boxes_[t] = sheets.points.enclosure(sheets.vertices[a]);
        for (const std::uint32_t corner : {b, c})
            add_to(boxes_[t], sheets.points.enclosure(sheets.vertices[corner]));
    }
}

void TriangleBoxes::build_tree() {
    if (!order_.empty()) add_node(0, static_cast<std::uint32_t>(order_.size()));
    // NOLINTNEXTLINE(modernize-loop-convert): nodes are added on the way
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const std::uint32_t first = nodes_[n].first, last = nodes_[n].last;
        if (last - first <= most_triangles_in_leaf) continue;
        const std::size_t longest = axis_of_split(std::span(order_).subspan(first, last - first));
        const auto key = [&](std::uint32_t t) { return std::pair(middle(t, longest), t); };
        const std::uint32_t half = first + (last - first) / 2;
        std::nth_element(order_.begin() + first, order_.begin() + half, order_.begin() + last,
                         [&](std::uint32_t s, std::uint32_t t) { return key(s) < key(t); });
        nodes_[n].children = static_cast<std::uint32_t>(nodes_.size());
        add_node(first, half);
        add_node(half, last);
    }
}

double TriangleBoxes::middle(std::uint32_t triangle, std::size_t axis) const {
    return boxes_[triangle].low[axis] / 2 + boxes_[triangle].high[axis] / 2;
}

/// Returns the axis along which the middles of triangles spread most.
std::size_t TriangleBoxes::axis_of_split(std::span<const std::uint32_t> triangles) const {
    std::array<double, 3> spread{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] =
            std::ranges::minmax(triangles, {}, [&](std::uint32_t t) { return middle(t, i); });
        spread[i] = middle(high, i) - middle(low, i);
    }
    return static_cast<std::size_t>(std::ranges::max_element(spread) - spread.begin());
}

void TriangleBoxes::add_node(std::uint32_t first, std::uint32_t last) {
    Enclosure all = boxes_[order_[first]];
    for (std::uint32_t i = first; i < last; ++i) add_to(all, boxes_[order_[i]]);
    nodes_.push_back({all, first, last});
}

} // namespace terrane::volumes
