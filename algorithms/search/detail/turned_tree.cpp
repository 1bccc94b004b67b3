// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/search/detail/turned_tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace terrane::search {
namespace {

using Corners = std::array<Vector, 3>;

/// Returns the vector with length 1, or nothing if it is too short.
std::optional<Vector> unit(const Vector& v) {
    const double most = std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
    if (!(most > 0x1p-500)) return std::nullopt;
    const Vector w{v[0] / most, v[1] / most, v[2] / most};
    const double length = std::sqrt(dot(w, w));
    return Vector{w[0] / length, w[1] / length, w[2] / length};
}

Vector longest_side(const Corners& c) {
    Vector longest{};
    for (unsigned i = 0; i < 3; ++i) {
        const Vector side = sum(1, c.at((i + 1) % 3), -1, c.at(i));
        if (dot(side, side) > dot(longest, longest)) longest = side;
    }
    return longest;
}

/// Adds vectors of either direction, each in that of the sum.
void add_aligned(Vector& to, const Vector& v) {
    to = sum(1, to, dot(to, v) < 0 ? -1 : 1, v);
}

/// Returns the part of v across a unit vector, as a unit vector; nothing if it is a small part.
std::optional<Vector> across(const Vector& v, const Vector& axis) {
    const auto direction = unit(v);
    if (!direction) return std::nullopt;
    Vector part = sum(1, *direction, -dot(*direction, axis), axis);
    if (dot(part, part) < 0x1p-20) return std::nullopt;
    part = sum(1, part, -dot(part, axis), axis);
    return unit(part);
}

using Axes = std::array<Vector, 3>;

constexpr Axes plain_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Statement (1).
bool are_orthonormal(const Axes& axes) {
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = i; j < 3; ++j)
            if (!(std::fabs(dot(axes.at(i), axes.at(j)) - (i == j ? 1 : 0)) <= 0x1p-46))
                return false;
    return true;
}

/// Returns axes along the long sides of triangles, in their planes, and across these. Any axes are right.
Axes axes_along(std::span<const Corners> triangles) {
    constexpr std::size_t samples = 32;
    Vector along{}, normal{};
    for (std::size_t i = 0; i < triangles.size(); i += triangles.size() / samples + 1) {
        const Corners& c = triangles[i];
        add_aligned(along, longest_side(c));
        add_aligned(normal, cross(sum(1, c[1], -1, c[0]), sum(1, c[2], -1, c[0])));
    }
    const auto first = unit(along);
    if (!first) return plain_axes;
    auto last = across(normal, *first);
    for (unsigned k = 0; k < 3 && !last; ++k) last = across(plain_axes.at(k), *first);
    if (!last) return plain_axes;
    const Axes axes{*first, cross(*last, *first), *last};
    return are_orthonormal(axes) ? axes : plain_axes;
}

/// Returns the label of all triangles, or no_group.
std::uint32_t common_label(std::span<const std::uint32_t> labels,
                           std::span<const std::uint32_t> triangles) {
    if (labels.empty()) return no_group;
    const std::uint32_t first = labels[triangles[0]];
    for (const std::uint32_t t : triangles)
        if (labels[t] != first) return no_group;
    return first;
}

} // namespace

TurnedBox turned_box(std::span<const Corners> triangles) {
    TurnedBox box{axes_along(triangles), {}, {}};
    constexpr double far = std::numeric_limits<double>::infinity();
    Vector low{far, far, far}, high{-far, -far, -far};
    for (const Corners& c : triangles)
        for (const Vector& p : c)
            for (unsigned k = 0; k < 3; ++k) {
                const double t = dot(box.axes[k], p);
                low[k] = std::min(low[k], t);
                high[k] = std::max(high[k], t);
            }
    for (unsigned k = 0; k < 3; ++k) {
        box.centre = sum(1, box.centre, (low[k] + high[k]) / 2, box.axes[k]);
        box.half[k] = (high[k] - low[k]) / 2 + 0x1p-43; // statement (2)
    }
    return box;
}

UnitMap::UnitMap(const BoxSource& source, std::span<const std::uint32_t> chosen,
                 std::span<const std::uint32_t> others) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Vector low{far, far, far}, high{-far, -far, -far};
    for (const auto& part : {chosen, others})
        for (const std::uint32_t t : part) {
            const Box box = source[t];
            for (unsigned k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], box.low[k]);
                high[k] = std::max(high[k], box.high[k]);
            }
        }
    double extent = 0, largest = 0; // half of the largest extent
    for (unsigned k = 0; k < 3; ++k) {
        const double half = high[k] / 2 - low[k] / 2;
        half_centre_[k] = low[k] / 2 + half / 2;
        extent = std::max(extent, half);
        largest = std::max({largest, std::fabs(low[k]), std::fabs(high[k])});
    }
    if (!(extent > 0x1p-900 && extent < far)) return;
    factor_ = 1 / extent;
    room_ += 0x1p-47 * (largest * factor_);
}

bool TurnedBox::is_apart(const TurnedBox& o, double room) const {
    const Vector d = sum(1, o.centre, -1, centre);
    std::array<Vector, 3> products{}; // of the axes of both
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned j = 0; j < 3; ++j) products[i][j] = std::fabs(dot(axes[i], o.axes[j]));
        if (std::fabs(dot(axes[i], d)) > half[i] + dot(products[i], o.half) + room) return true;
    }
    for (unsigned j = 0; j < 3; ++j) {
        const double other =
            half[0] * products[0][j] + half[1] * products[1][j] + half[2] * products[2][j];
        if (std::fabs(dot(o.axes[j], d)) > o.half[j] + other + room) return true;
    }
    const Vector u = cross(axes[0], o.axes[0]);
    double reach = room;
    for (unsigned k = 0; k < 3; ++k)
        reach += half[k] * std::fabs(dot(axes[k], u)) + o.half[k] * std::fabs(dot(o.axes[k], u));
    return std::fabs(dot(u, d)) > reach;
}

/// A triangle by the two ends of its longest side. So those that stand together are near, and run alike.
struct TurnedTree::Item {
    std::array<float, 6> key;
    std::uint32_t triangle;
};

TurnedTree::TurnedTree(const BoxSource& source, std::span<const std::uint32_t> chosen,
                       const PairLabels& labels, const UnitMap& map) :
    source_(source),
    labels_(labels), room_(map.room()) {
    const auto mapped = [&](std::uint32_t t) {
        const auto [a, b, c] = corners(t);
        return Corners{map(a), map(b), map(c)};
    };
    std::vector<Item> items;
    items.reserve(chosen.size());
    for (const std::uint32_t t : chosen) {
        const Corners c = mapped(t);
        const Vector side = longest_side(c);
        const Vector middle{(c[0][0] + c[1][0] + c[2][0]) / 3, (c[0][1] + c[1][1] + c[2][1]) / 3,
                            (c[0][2] + c[1][2] + c[2][2]) / 3};
        const double sign = side < Vector{} ? -0.5 : 0.5;
        Item item{{}, t};
        for (unsigned k = 0; k < 3; ++k) {
            item.key.at(k) = static_cast<float>(middle.at(k) - sign * side.at(k));
            item.key.at(k + 3) = static_cast<float>(middle.at(k) + sign * side.at(k));
        }
        items.push_back(item);
    }
    nodes_.reserve(items.size() / 2 + 1);
    add(items, 0);
    std::vector<Corners> all;
    all.reserve(items.size());
    for (const Item& item : items) {
        order_.push_back(item.triangle);
        boxes_.push_back(source_[item.triangle]);
        all.push_back(mapped(item.triangle));
    }
    for (Node& node : nodes_) {
        const std::uint32_t count = node.end - node.first;
        node.box = turned_box(std::span(all).subspan(node.first, count));
        const auto triangles = std::span(order_).subspan(node.first, count);
        node.group = common_label(labels_.groups, triangles);
        node.crowd = common_label(labels_.crowds, triangles);
    }
}

/// Adds the tree of some items, which stand from `first` on. Returns its root.
std::uint32_t TurnedTree::add(std::span<Item> items, std::uint32_t first) {
    const auto here = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, first + static_cast<std::uint32_t>(items.size())});
    if (items.size() <= leaf_size) {
        leaves_.push_back(here);
        return here;
    }
    std::array<float, 6> low = items[0].key, high = low;
    for (const Item& item : items)
        for (unsigned k = 0; k < 6; ++k) {
            low.at(k) = std::min(low.at(k), item.key.at(k));
            high.at(k) = std::max(high.at(k), item.key.at(k));
        }
    unsigned widest = 0;
    for (unsigned k = 1; k < 6; ++k)
        if (high.at(k) - low.at(k) > high.at(widest) - low.at(widest)) widest = k;
    const std::size_t half = items.size() / 2;
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                     [&](const Item& a, const Item& b) {
                         const float x = a.key.at(widest), y = b.key.at(widest);
                         return x != y ? x < y : a.triangle < b.triangle;
                     });
    add(items.first(half), first);
    const std::uint32_t right = add(items.subspan(half), first + static_cast<std::uint32_t>(half));
    nodes_[here].right = right;
    return here;
}

} // namespace terrane::search
