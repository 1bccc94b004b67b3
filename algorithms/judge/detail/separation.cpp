// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/detail/separation.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/no_index.hpp>

namespace terrane::judging {

namespace {

/// Returns the neighbours of each vertex along edges.
IndexLists<std::uint32_t> neighbours_along(const std::vector<Edge>& edges, std::size_t vertices) {
    std::vector<std::uint32_t> from, to;
    for (const auto& [low, high] : edges) {
        from.insert(from.end(), {low, high});
        to.insert(to.end(), {high, low});
    }
    return lists_by_key<std::uint32_t>(vertices, from, [&](std::size_t i) { return to[i]; });
}

std::vector<Edge> edges_of(const EdgeSides& sides) {
    std::vector<Edge> edges;
    sides.for_each([&](std::uint32_t low, std::uint32_t high, auto) {
        edges.push_back({low, high});
    });
    return edges;
}

} // namespace

Separation::Separation(const Target& target, const Cells& cells, const OutputMesh& output,
                       const Matching& matching, double bound) :
    target_(target),
    output_(output), matching_(matching), bound_(bound),
    neighbours_(neighbours_along(cells.edges, target.exact.vertices.size())),
    around_(neighbours_along(edges_of(output.soup.edges), output.soup.points.size())) {
    for (std::uint32_t x = 0; x < neighbours_.size(); ++x)
        if (!neighbours_[x].empty() && matching.image[x] == no_index && !is_passed(x))
            missing_.push_back(x);
    for (const CellEdge& e : cells.boundary) {
        const auto vertices = image(e.from, e.to);
        for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
            const std::uint32_t u = vertices[i], w = vertices[i + 1];
            boundary_.push_back({e.cell, u, w});
            separating_.push_back({std::min(u, w), std::max(u, w)});
        }
    }
    sort_unique(separating_);
}

bool Separation::separates(std::uint32_t u, std::uint32_t w) const {
    return std::ranges::binary_search(separating_, Edge{std::min(u, w), std::max(u, w)});
}

std::vector<std::uint32_t> Separation::image(std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t first = matching_.image[from];
    if (first == no_index) return {};
    while (matching_.image[to] == no_index) {
        if (!is_passed(to)) return {};
        const auto both = neighbours_[to];
        from = std::exchange(to, both[both[0] == from ? 1 : 0]);
    }
    const std::uint32_t last = matching_.image[to];
    if (first == last) return {first};
    if (!output_.has_edge(first, last))
        if (auto found = near_path(first, last); !found.empty()) return found;
    return {first, last};
}

bool Separation::has_path(const std::vector<std::uint32_t>& vertices) const {
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        if (!output_.has_edge(vertices[i], vertices[i + 1])) return false;
    return !vertices.empty();
}

std::vector<std::uint32_t> Separation::near_path(std::uint32_t u, std::uint32_t w) const {
    const auto& points = output_.soup.points;
    const Point3 &p = points[u], &q = points[w];
    const Point3 d{q.x - p.x, q.y - p.y, q.z - p.z};
    const double square = d.x * d.x + d.y * d.y + d.z * d.z;
    const auto share = [&](std::uint32_t v) {
        const Point3& r = points[v];
        return ((r.x - p.x) * d.x + (r.y - p.y) * d.y + (r.z - p.z) * d.z) / square;
    };
    const auto is_near = [&](std::uint32_t v) {
        const double s = share(v);
        return difference(points[v], {p.x + s * d.x, p.y + s * d.y, p.z + s * d.z}) <= 2 * bound_;
    };
    std::vector<std::uint32_t> found{u};
    for (double at = 0; found.back() != w;) {
        std::uint32_t next = no_index;
        double least = 1;
        for (const std::uint32_t v : around_[found.back()]) {
            if (v == w && next == no_index) next = w;
            const double s = share(v);
            if (s <= at || s >= least || !is_near(v)) continue;
            least = s;
            next = v;
        }
        if (next == no_index) return {};
        at = least;
        found.push_back(next);
    }
    return found;
}

bool Separation::is_passed(std::uint32_t x) const {
    const auto around = neighbours_[x];
    return around.size() == 2 && collinear(around[0], x, around[1]);
}

bool Separation::collinear(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const UpwardRounding upward;
    const auto& exact = target_.exact;
    return std::ranges::all_of(std::array{Axis::x, Axis::y, Axis::z}, [&](Axis axis) {
        return exact.state->points.orient2d(upward, axis, exact.vertices[x], exact.vertices[y],
                                            exact.vertices[z]) == Sign::Zero;
    });
}

std::vector<std::uint32_t> Separation::straight_path(std::uint32_t u, std::uint32_t w) const {
    for (const std::uint32_t x : matching_.preimages[u])
        for (const std::uint32_t y : matching_.preimages[w])
            if (auto found = path(x, y); !found.empty()) return found;
    return {};
}

std::vector<std::uint32_t> Separation::path(std::uint32_t x, std::uint32_t y) const {
    const auto& exact = target_.exact;
    const auto order = [&](std::uint32_t a, std::uint32_t b) {
        return exact.state->points.compare(exact.vertices[a], exact.vertices[b]);
    };
    std::vector<std::uint32_t> found{matching_.image[x]};
    for (std::uint32_t at = x; at != y;) {
        const auto next = std::ranges::find_if(neighbours_[at], [&](std::uint32_t n) {
            return n == y || (order(at, n) == order(x, y) && order(n, y) == order(x, y) &&
                              collinear(x, n, y));
        });
        if (next == neighbours_[at].end()) return {};
        at = *next;
        const std::uint32_t v = matching_.image[at];
        if (v != no_index && v != found.back()) found.push_back(v);
    }
    return found;
}

} // namespace terrane::judging
