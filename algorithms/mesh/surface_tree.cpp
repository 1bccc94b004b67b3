// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/mesh/surface_tree.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <terrane/algorithms/mesh/median_tree.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>

namespace terrane {
namespace {

constexpr std::uint32_t most_in_a_leaf_of_surfaces = 4;
constexpr std::uint32_t no_surface = UINT32_MAX;

/// Returns the first surface that is not listed, or no_surface. Both lists are ascending.
std::uint32_t first_but(std::span<const std::uint32_t> surfaces,
                        std::span<const std::uint32_t> but) {
    for (const std::uint32_t s : surfaces)
        if (!std::binary_search(but.begin(), but.end(), s)) return s;
    return no_surface;
}

struct BoxOfTriangles {
    Point3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const Point3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

} // namespace

/// Distances to triangles are rounded, and so are those to boxes. A triangle is never nearer than its
/// box: `least` is the larger of the two, so that what is found does not depend on the order of visits.
struct SurfaceTree::Best {
    double least;
    std::uint32_t surface = no_surface;
    double distance = 0; ///< to the triangle

    /// Tells whether a surface from `number` on, at this distance or farther, may be better.
    [[nodiscard]] bool admits(double box_distance, std::uint32_t number) const {
        return std::tie(box_distance, number) < std::tie(least, surface);
    }
};

SurfaceTree::SurfaceTree(const TrianglesOfSurfaces& all) : all_(all) {
    for (std::uint32_t t = 0; t < all.triangles.size(); ++t)
        if (!all.surfaces_of[t].empty()) order_.push_back(t);
    const auto middle = [&](std::uint32_t t) {
        const auto& [i, j, k] = all.triangles[t];
        const Point3 &a = all.points[i], &b = all.points[j], &c = all.points[k];
        return std::array{a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z};
    };
    build_median_tree(order_, nodes_, most_in_a_leaf_of_surfaces, middle,
                      [&](std::uint32_t first, std::uint32_t last) { return node(first, last); });
}

void SurfaceTree::Node::name(std::uint32_t surface) {
    least = std::min(least, surface);
    const auto end = surfaces.begin() + std::min(count, most_named);
    if (count > most_named || std::find(surfaces.begin(), end, surface) != end) return;
    if (count < most_named) surfaces[count] = surface;
    ++count;
}

bool SurfaceTree::Node::is_of(std::span<const std::uint32_t> listed) const {
    return count <= most_named &&
           std::all_of(surfaces.begin(), surfaces.begin() + count, [&](std::uint32_t s) {
               return std::binary_search(listed.begin(), listed.end(), s);
           });
}

SurfaceTree::Node SurfaceTree::node(std::uint32_t first, std::uint32_t last) const {
    BoxOfTriangles box;
    Node made{{}, {}, first, last, no_surface};
    for (std::uint32_t i = first; i < last; ++i) {
        for (const std::uint32_t v : all_.triangles[order_[i]]) box.add(all_.points[v]);
        for (const std::uint32_t s : all_.surfaces_of[order_[i]]) made.name(s);
    }
    made.low = box.low;
    made.high = box.high;
    return made;
}

double SurfaceTree::distance_to_box(const Point3& p, std::uint32_t triangle) const {
    BoxOfTriangles box;
    for (const std::uint32_t v : all_.triangles[triangle]) box.add(all_.points[v]);
    return terrane::distance_to_box(p, box.low, box.high);
}

void SurfaceTree::visit(const Point3& p, std::span<const std::uint32_t> but, std::uint32_t triangle,
                        Best& best) const {
    const std::uint32_t surface = first_but(all_.surfaces_of[triangle], but);
    if (surface == no_surface) return;
    const auto& [a, b, c] = all_.triangles[triangle];
    const double distance = distance_to_triangle(p, all_.points[a], all_.points[b], all_.points[c]);
    const double least = std::max(distance, distance_to_box(p, triangle));
    if (std::tie(least, surface, distance) < std::tie(best.least, best.surface, best.distance))
        best = {least, surface, distance};
}

std::optional<NearestSurface> SurfaceTree::nearest(const Point3& p,
                                                   std::span<const std::uint32_t> but, double bound,
                                                   std::size_t* visits) const {
    if (nodes_.empty()) return std::nullopt;
    Best best{bound, 0}; // surface 0: what is found must be nearer than the bound
    struct Open {
        std::uint32_t node;
        double distance; ///< from the point to the box of the node
        std::uint32_t least;
    };
    const auto opened = [&](std::uint32_t n) {
        return Open{n, terrane::distance_to_box(p, nodes_[n].low, nodes_[n].high), nodes_[n].least};
    };
    std::vector<Open> stack{opened(0)};
    while (!stack.empty()) {
        const Open next = stack.back();
        stack.pop_back();
        if (visits != nullptr) ++*visits;
        if (!best.admits(next.distance, next.least) || nodes_[next.node].is_of(but)) continue;
        if (nodes_[next.node].last - nodes_[next.node].first <= most_in_a_leaf_of_surfaces) {
            for (std::uint32_t i = nodes_[next.node].first; i < nodes_[next.node].last; ++i)
                visit(p, but, order_[i], best);
            continue;
        }
        Open first = opened(nodes_[next.node].children),
             second = opened(nodes_[next.node].children + 1);
        if (std::tie(second.distance, second.least) < std::tie(first.distance, first.least))
            std::swap(first, second);
        stack.push_back(second);
        stack.push_back(first);
    }
    if (best.least >= bound) return std::nullopt;
    return NearestSurface{best.surface, best.distance, best.least};
}

std::vector<std::uint32_t> SurfaceTree::within(const Point3& p, std::span<const std::uint32_t> but,
                                               double bound) const {
    std::vector<std::uint32_t> found, open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (terrane::distance_to_box(p, node.low, node.high) > bound || node.is_of(but)) continue;
        if (node.children > 0) {
            open.insert(open.end(), {node.children, node.children + 1});
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) {
            if (distance_to_box(p, order_[i]) > bound) continue;
            for (const std::uint32_t s : all_.surfaces_of[order_[i]])
                if (!std::binary_search(but.begin(), but.end(), s)) found.push_back(s);
        }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

} // namespace terrane
