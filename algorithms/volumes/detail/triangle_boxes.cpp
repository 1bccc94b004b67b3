// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volumes/detail/triangle_boxes.hpp>

#include <algorithm>
#include <array>
#include <numeric>

#include <terrane/algorithms/mesh/median_tree.hpp>

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
    const auto middle = [&](std::uint32_t t) {
        const Enclosure& box = boxes_[t];
        std::array<double, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = box.low[i] / 2 + box.high[i] / 2;
        return at;
    };
    const auto node = [&](std::uint32_t first, std::uint32_t last) {
        Enclosure all = boxes_[order_[first]];
        for (std::uint32_t i = first; i < last; ++i) add_to(all, boxes_[order_[i]]);
        return Node{all, first, last};
    };
    build_median_tree(order_, nodes_, most_triangles_in_leaf, middle, node);
}

} // namespace terrane::volumes
