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

bool TriangleBoxes::is_near(std::uint32_t triangle, const AxisLine& line) const {
    if (!line.known) return true;
    const auto& [a, b, c] = sheets_.triangles[triangle];
    // Rounding to nearest keeps the order, so that doubles tell on which side of a double points are.
    const auto at = [&](std::uint32_t v) -> const Point3& {
        return sheets_.points.nearest(sheets_.vertices[v]);
    };
    const Point3 &p = at(a), &q = at(b), &r = at(c);
    const auto covers = [&](double Point3::*k, double x) {
        return !(p.*k > x && q.*k > x && r.*k > x) && !(p.*k < x && q.*k < x && r.*k < x);
    };
    constexpr std::array coordinates{&Point3::x, &Point3::y, &Point3::z};
    return covers(coordinates[(line.axis + 1) % 3], line.u) &&
           covers(coordinates[(line.axis + 2) % 3], line.v);
}

void TriangleBoxes::build_tree() {
    boxes_.reserve(count_);
    for (std::uint32_t t = 0; t < count_; ++t) {
        const auto& [a, b, c] = sheets_.triangles[t];
        boxes_.push_back(sheets_.points.enclosure(sheets_.vertices[a]));
        for (const std::uint32_t corner : {b, c})
            add_to(boxes_[t], sheets_.points.enclosure(sheets_.vertices[corner]));
    }
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), 0U);
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
