// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace terrane {
namespace {

constexpr std::uint32_t most_in_leaf = 4;

/// Returns the position on the segment a b of the point nearest to p, from 0 at a to 1 at b.
double nearest_share(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 d = minus(b, a), from = minus(p, a);
    const double square = dot(d, d);
    return square > 0 ? std::clamp(dot(from, d) / square, 0.0, 1.0) : 0;
}

double distance_to_segment(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 d = minus(b, a), from = minus(p, a);
    const double t = nearest_share(p, a, b);
    return length(minus(from, {t * d.x, t * d.y, t * d.z}));
}

Point3 nearest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
    const double t = nearest_share(p, a, b);
    const Point3 d = minus(b, a);
    return {a.x + t * d.x, a.y + t * d.y, a.z + t * d.z};
}

} // namespace

double distance_to_box(const Point3& p, const Point3& low, const Point3& high) {
    const auto beyond = [](double x, double l, double h) { return std::max({l - x, 0.0, x - h}); };
    return length(
        {beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)});
}

double distance_to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    const Point3 n = cross(minus(b, a), minus(c, a));
    const auto inside = [&](const Point3& from, const Point3& to) {
        return dot(cross(minus(to, from), minus(p, from)), n) >= 0;
    };
    const double size = length(n);
    if (size > 0 && inside(a, b) && inside(b, c) && inside(c, a))
        return std::fabs(dot(minus(p, a), n)) / size;
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

Point3 nearest_on_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    const Point3 n = cross(minus(b, a), minus(c, a));
    const auto inside = [&](const Point3& from, const Point3& to) {
        return dot(cross(minus(to, from), minus(p, from)), n) >= 0;
    };
    const double square = dot(n, n);
    if (square > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
        const double f = dot(minus(p, a), n) / square;
        return {p.x - f * n.x, p.y - f * n.y, p.z - f * n.z};
    }
    const std::array sides{nearest_on_segment(p, a, b), nearest_on_segment(p, b, c),
                           nearest_on_segment(p, c, a)};
    return *std::min_element(sides.begin(), sides.end(), [&](const Point3& q, const Point3& r) {
        return length(minus(q, p)) < length(minus(r, p));
    });
}

/// A triangle while the tree is built: what the splits compare lies together.
struct TriangleTree::Item {
    Point3 low, high;
    Point3 sum; ///< of the corners
    Triangle triangle{};

    Item(const Triangle& t, const Point3& a, const Point3& b, const Point3& c) :
        low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
        high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})},
        sum{a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z}, triangle(t) {}
};

TriangleTree::TriangleTree(std::span<const Point3> points, std::vector<Triangle> triangles) :
    points_(points), triangles_(std::move(triangles)) {
    if (triangles_.empty()) return;
    std::vector<Item> items;
    items.reserve(triangles_.size());
    for (const Triangle& t : triangles_)
        items.emplace_back(t, points_[t[0]], points_[t[1]], points_[t[2]]);
    nodes_.reserve(items.size()); // about as many: leaves have two to four triangles
    build(items, 0, static_cast<std::uint32_t>(items.size()));
    for (std::size_t k = 0; k < items.size(); ++k) triangles_[k] = items[k].triangle;
}

std::uint32_t TriangleTree::build(std::vector<Item>& items, std::uint32_t first,
                                  std::uint32_t last) {
    const auto at = static_cast<std::uint32_t>(nodes_.size());
    Node node{items[first].low, items[first].high, first, last, 0, 0};
    for (std::uint32_t k = first + 1; k < last; ++k) {
        const Point3 &low = items[k].low, &high = items[k].high;
        node.low = {std::min(node.low.x, low.x), std::min(node.low.y, low.y),
                    std::min(node.low.z, low.z)};
        node.high = {std::max(node.high.x, high.x), std::max(node.high.y, high.y),
                     std::max(node.high.z, high.z)};
    }
    nodes_.push_back(node);
    if (last - first <= most_in_leaf) return at;
    const Point3 size = minus(node.high, node.low);
    const auto longest = size.x >= size.y && size.x >= size.z ? &Point3::x
                         : size.y >= size.z                   ? &Point3::y
                                                              : &Point3::z;
    const std::uint32_t half = first + (last - first) / 2;
    std::nth_element(items.begin() + first, items.begin() + half, items.begin() + last,
                     [&](const Item& i, const Item& j) {
                         const double x = i.sum.*longest, y = j.sum.*longest;
                         return x < y || (x == y && i.triangle < j.triangle);
                     });
    const std::uint32_t left = build(items, first, half), right = build(items, half, last);
    nodes_[at].left = left;
    nodes_[at].right = right;
    return at;
}

template <class Visit>
void TriangleTree::for_near(const Point3& p, const double& bound, const Visit& visit) const {
    if (nodes_.empty()) return;
    struct Open {
        std::uint32_t node;
        double distance; ///< from the point to the box of the node
    };
    const auto opened = [&](std::uint32_t n) {
        return Open{n, distance_to_box(p, nodes_[n].low, nodes_[n].high)};
    };
    std::array<Open, 96> stack; // at most two per level of the balanced tree
    std::size_t top = 0;
    stack[top++] = opened(0);
    while (top > 0) {
        const Open next = stack[--top];
        if (next.distance >= bound) continue;
        const Node& node = nodes_[next.node];
        if (node.left == 0) {
            for (std::uint32_t t = node.first; t < node.last; ++t) visit(triangles_[t]);
            continue;
        }
        const Open left = opened(node.left), right = opened(node.right);
        const bool left_first = left.distance <= right.distance;
        stack[top++] = left_first ? right : left;
        stack[top++] = left_first ? left : right;
    }
}

double TriangleTree::distance(const Point3& p, double bound) const {
    for_near(p, bound, [&](const Triangle& t) {
        const auto& [a, b, c] = t;
        bound = std::min(bound, distance_to_triangle(p, points_[a], points_[b], points_[c]));
    });
    return bound;
}

std::optional<TriangleTree::Near> TriangleTree::nearest(const Point3& p, double bound) const {
    std::optional<Near> best;
    for_near(p, bound, [&](const Triangle& t) {
        const auto& [a, b, c] = t;
        const Point3 q = nearest_on_triangle(p, points_[a], points_[b], points_[c]);
        const double d = length(minus(q, p));
        if (d >= bound) return;
        bound = d;
        best = Near{q, d, t};
    });
    return best;
}

std::vector<TriangleTree::Near> TriangleTree::within(const Point3& p, double bound) const {
    std::vector<Near> all;
    for_near(p, bound, [&](const Triangle& t) {
        const auto& [a, b, c] = t;
        const Point3 q = nearest_on_triangle(p, points_[a], points_[b], points_[c]);
        const double d = length(minus(q, p));
        if (d < bound) all.push_back({q, d, t});
    });
    return all;
}

} // namespace terrane
