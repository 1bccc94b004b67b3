// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/measure.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <deque>
#include <mutex>
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

double direct_distance_to_box(const Point3& p, const Point3& low, const Point3& high) {
    const auto beyond = [](double x, double l, double h) { return std::max({l - x, 0.0, x - h}); };
    return length(
        {beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)});
}

double direct_distance_to_triangle(const Point3& p, const Point3& a, const Point3& b,
                                   const Point3& c) {
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

} // namespace

double distance_to_box(const Point3& p, const Point3& low, const Point3& high) {
    return measure(1, direct_distance_to_box, p, low, high);
}

double distance_to_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    return measure(1, direct_distance_to_triangle, p, a, b, c);
}

Point3 nearest_on_triangle(const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
    const Point3 n = cross(minus(b, a), minus(c, a));
    const auto inside = [&](const Point3& from, const Point3& to) {
        return dot(cross(minus(to, from), minus(p, from)), n) >= 0;
    };
    const double square = dot(n, n);
    if (!std::isfinite(square)) { // too large for squares of areas
        const auto by = [](const Point3& q, int exponent) {
            return Point3{std::ldexp(q.x, exponent), std::ldexp(q.y, exponent),
                          std::ldexp(q.z, exponent)};
        };
        double size = 0;
        for (const Point3& q : {p, a, b, c})
            size = std::max({size, std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)});
        const int to_one = -std::ilogb(size);
        return by(nearest_on_triangle(by(p, to_one), by(a, to_one), by(b, to_one), by(c, to_one)),
                  -to_one);
    }
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

/// A range of the triangles, and their box.
struct TriangleTree::Node {
    Point3 low, high;
    std::uint32_t first, last;
    std::atomic<Node*> left{}; ///< null: a leaf, or not split yet
    Node* right{};

    Node(const std::vector<Triangle>& triangles, std::span<const Point3> points,
         std::uint32_t begin, std::uint32_t end) :
        low{HUGE_VAL, HUGE_VAL, HUGE_VAL},
        high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, first(begin), last(end) {
        for (std::uint32_t k = first; k < last; ++k)
            for (const std::uint32_t v : triangles[k]) {
                const Point3& p = points[v];
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    }

    [[nodiscard]] bool is_leaf() const { return last - first <= most_in_leaf; }
};

/// The nodes that searches have needed so far. A node changes once, when it is split; others may look at
/// nodes with other triangles meanwhile.
struct TriangleTree::Nodes {
    std::vector<Triangle> triangles; ///< in the order of the nodes
    std::mutex mutex{};              ///< of those who split
    std::deque<Node> all{};          ///< the root is the first one; they never move

    /// Returns the left one of the two parts of a node that is no leaf; the right one is set as well.
    Node* split(Node& node, std::span<const Point3> points) {
        if (Node* const left = node.left.load(std::memory_order_acquire)) return left;
        const std::scoped_lock lock(mutex);
        if (Node* const left = node.left.load(std::memory_order_relaxed)) return left;
        const Point3 size = minus(node.high, node.low);
        const auto longest = size.x >= size.y && size.x >= size.z ? &Point3::x
                             : size.y >= size.z                   ? &Point3::y
                                                                  : &Point3::z;
        struct Item {
            double sum; ///< of the corners' coordinates
            Triangle triangle;
        };
        std::vector<Item> items;
        items.reserve(node.last - node.first);
        for (std::uint32_t k = node.first; k < node.last; ++k) {
            const auto& [a, b, c] = triangles[k];
            items.push_back(
                {points[a].*longest + points[b].*longest + points[c].*longest, triangles[k]});
        }
        const std::uint32_t half = (node.last - node.first) / 2;
        std::nth_element(items.begin(), items.begin() + half, items.end(),
                         [](const Item& i, const Item& j) {
                             return i.sum < j.sum || (i.sum == j.sum && i.triangle < j.triangle);
                         });
        for (std::uint32_t k = node.first; k < node.last; ++k)
            triangles[k] = items[k - node.first].triangle;
        Node& left = all.emplace_back(triangles, points, node.first, node.first + half);
        node.right = &all.emplace_back(triangles, points, node.first + half, node.last);
        node.left.store(&left, std::memory_order_release);
        return &left;
    }
};

TriangleTree::TriangleTree(std::span<const Point3> points, std::vector<Triangle> triangles) :
    points_(points), nodes_(new Nodes{std::move(triangles)}) {
    const auto& all = nodes_->triangles;
    if (!all.empty())
        nodes_->all.emplace_back(all, points, 0U, static_cast<std::uint32_t>(all.size()));
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

template <class Visit>
void TriangleTree::for_near(const Point3& p, const double& bound, const Visit& visit) const {
    if (nodes_->all.empty()) return;
    struct Open {
        Node* node;
        double distance; ///< from the point to the box of the node
    };
    const auto opened = [&](Node* n) { return Open{n, distance_to_box(p, n->low, n->high)}; };
    std::array<Open, 96> stack; // at most two per level of the balanced tree
    std::size_t top = 0;
    stack[top++] = opened(&nodes_->all.front());
    while (top > 0) {
        const Open next = stack[--top];
        if (next.distance >= bound) continue;
        Node& node = *next.node;
        if (node.is_leaf()) {
            for (std::uint32_t t = node.first; t < node.last; ++t) visit(nodes_->triangles[t]);
            continue;
        }
        const Open left = opened(nodes_->split(node, points_)), right = opened(node.right);
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
