// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/rbf/detail/data.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/core/index_lists.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/rbf/detail/long_edges.hpp>

namespace terrane {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

IndexLists<std::uint32_t> neighbours_in(const Soup& soup) {
    std::vector<std::vector<std::uint32_t>> lists(soup.points.size());
    soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto) {
        lists[low].push_back(high);
        lists[high].push_back(low);
    });
    IndexLists<std::uint32_t> flat;
    for (const auto& l : lists) flat.push_back(l);
    return flat;
}

/// Computes each vertex's distance from the loop along edges; infinite beyond both limits.
std::vector<double> distances_from(const Soup& soup, std::span<const std::uint32_t> loop,
                                   double reach, unsigned rings) {
    const auto neighbours = neighbours_in(soup);
    std::vector<double> distance(soup.points.size(), never);
    std::vector<unsigned> ring(soup.points.size(), UINT32_MAX);
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    std::vector<std::uint32_t> front(loop.begin(), loop.end());
    for (unsigned r = 0; r <= rings; ++r) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t v : front) {
            if (ring[v] != UINT32_MAX) continue;
            ring[v] = r;
            for (const std::uint32_t w : neighbours[v]) next.push_back(w);
        }
        front.swap(next);
    }
    for (const std::uint32_t v : loop) {
        distance[v] = 0;
        open.emplace(0, v);
    }
    while (!open.empty()) {
        const auto [d, v] = open.top();
        open.pop();
        if (d > distance[v]) continue;
        for (const std::uint32_t w : neighbours[v]) {
            const double via = d + length(minus(soup.points[w], soup.points[v]));
            if (via >= distance[w] || (via > reach && ring[w] == UINT32_MAX)) continue;
            distance[w] = via;
            open.emplace(via, w);
        }
    }
    return distance;
}

/// Orients triangles along the loops, then their neighbours across edges of two triangles.
void orient_by_loops(RbfData& data) {
    auto& triangles = data.triangles;
    const std::size_t border = data.next.size();
    const EdgeSides edges = group_edges(triangles, data.points.size());
    std::vector<std::vector<std::uint32_t>> beside(triangles.size());
    std::vector<bool> done(triangles.size(), false);
    std::vector<std::uint32_t> front;
    const auto orient = [&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
        if (done[t]) return;
        done[t] = true;
        if (!runs_along(triangles[t], from, to)) std::swap(triangles[t][1], triangles[t][2]);
        front.push_back(t);
    };
    edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() == 2) {
            beside[sides[0].triangle].push_back(sides[1].triangle);
            beside[sides[1].triangle].push_back(sides[0].triangle);
        } else if (sides.size() == 1 && high < border) {
            if (data.next[low] == high) orient(sides[0].triangle, low, high);
            if (data.next[high] == low) orient(sides[0].triangle, high, low);
        }
    });
    while (!front.empty()) {
        const std::uint32_t here = front.back();
        front.pop_back();
        const Triangle t = triangles[here];
        for (const std::uint32_t other : beside[here])
            for (unsigned k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                const Triangle& o = triangles[other];
                const auto has = [&](std::uint32_t v) {
                    return o[0] == v || o[1] == v || o[2] == v;
                };
                if (has(a) && has(b)) orient(other, b, a);
            }
    }
}

void find_normals(RbfData& data) {
    data.normals.assign(data.points.size(), {});
    for (const Triangle& t : data.triangles)
        for (unsigned k = 0; k < 3; ++k) { // weighted by the angle
            const Point3 &p = data.points[t[k]], &q = data.points[t[(k + 1) % 3]],
                         &r = data.points[t[(k + 2) % 3]];
            const Point3 u = minus(q, p), v = minus(r, p), n = cross(u, v);
            const double area = length(n), angle = std::atan2(area, dot(u, v));
            if (!(area > 0)) continue;
            Point3& sum = data.normals[t[k]];
            sum = {sum.x + angle * n.x / area, sum.y + angle * n.y / area,
                   sum.z + angle * n.z / area};
        }
    for (Point3& n : data.normals) {
        const double size = length(n);
        if (size > 0) n = {n.x / size, n.y / size, n.z / size};
    }
}

/// Tells whether p is within the loop, seen along its mean normal, and near its plane.
class WithinLoop {
public:
    WithinLoop(const Surface& surface, const BorderLoop& loop, double radius) :
        centre_(loop.centre), radius_(radius) {
        Point3 n;
        for (const std::uint32_t v : loop.vertices) points_.push_back(surface.vertices[v]);
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Point3 c = cross(minus(points_[i], centre_), minus(at(i + 1), centre_));
            n = {n.x + c.x, n.y + c.y, n.z + c.z};
        }
        const double size = length(n);
        normal_ = size > 0 ? Point3{n.x / size, n.y / size, n.z / size} : Point3{0, 0, 1};
    }
    [[nodiscard]] bool operator()(const Point3& p) const {
        double least = std::numeric_limits<double>::infinity(), most = -least, winding = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double height = dot(minus(points_[i], p), normal_);
            least = std::min(least, height);
            most = std::max(most, height);
            const Point3 a = flat(points_[i], p), b = flat(at(i + 1), p);
            winding += std::atan2(dot(cross(a, b), normal_), dot(a, b));
        }
        return std::fabs(winding) > 3 && least < radius_ && most > -radius_; // once around is 6.28
    }

private:
    [[nodiscard]] const Point3& at(std::size_t i) const { return points_[i % points_.size()]; }
    [[nodiscard]] Point3 flat(const Point3& q, const Point3& p) const {
        const Point3 d = minus(q, p);
        const double h = dot(d, normal_);
        return {d.x - h * normal_.x, d.y - h * normal_.y, d.z - h * normal_.z};
    }

    std::vector<Point3> points_;
    Point3 centre_, normal_;
    double radius_;
};

Status validate_loop(const Surface& surface, const BorderLoop& loop) {
    if (loop.vertices.size() < 3)
        return Error{ErrorCode::bad_option, "a loop needs three vertices", ""};
    for (const std::uint32_t v : loop.vertices)
        if (v >= surface.vertices.size())
            return Error{ErrorCode::bad_index, "the loop names no vertex", std::to_string(v)};
    return Done{};
}

double median_edge(const RbfData& data) {
    std::vector<double> edges;
    for (std::size_t i = 0; i < data.next.size(); ++i)
        edges.push_back(length(minus(data.points[data.next[i]], data.points[i])));
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
}

} // namespace

Result<RbfData> collect_data(const Surface& surface, const BorderLoop& loop,
                             std::span<const BorderLoop> loops, DataRange range) {
    if (const auto valid = validate(std::span(&surface, 1)); !valid) return valid.error();
    if (const auto valid = validate_loop(surface, loop); !valid) return valid.error();
    RbfData data;
    data.radius = std::sqrt(std::max(loop.area, 0.0) / std::acos(-1.0));
    std::vector<const BorderLoop*> borders{&loop};
    const WithinLoop within(surface, loop, data.radius);
    for (const BorderLoop& l : loops) {
        if (l.kind != LoopKind::outer || l.part == loop.part) continue;
        if (const auto valid = validate_loop(surface, l); !valid) return valid.error();
        if (within(surface.vertices[l.vertices[0]])) borders.push_back(&l);
    }
    const Soup soup = merge_surfaces(std::span(&surface, 1));
    std::vector<std::uint32_t> name(soup.points.size(), UINT32_MAX), of_borders;
    const auto add = [&](std::uint32_t v, double distance) {
        name[v] = static_cast<std::uint32_t>(data.points.size());
        data.points.push_back(soup.points[v]);
        data.distances.push_back(distance);
    };
    for (const BorderLoop* border : borders) {
        const auto first = static_cast<std::uint32_t>(data.next.size()),
                   n = static_cast<std::uint32_t>(border->vertices.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t v = border->vertices[i];
            if (name[v] != UINT32_MAX)
                return border == &loop
                           ? Error{ErrorCode::bad_option, "the loop passes a vertex twice",
                                   std::to_string(v)}
                           : Error{ErrorCode::unsupported,
                                   "an island touches the border of the hole, or another island",
                                   "vertex " + std::to_string(v)};
            add(v, 0);
            of_borders.push_back(v);
            data.next.push_back(first + (i + 1) % n);
        }
    }
    const auto distance = distances_from(soup, of_borders, range.reach * data.radius, range.rings);
    for (std::uint32_t v = 0; v < soup.points.size(); ++v)
        if (distance[v] < never && name[v] == UINT32_MAX) add(v, distance[v]);
    for (const Triangle& t : soup.triangles)
        if (distance[t[0]] < never && distance[t[1]] < never && distance[t[2]] < never)
            data.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
    orient_by_loops(data);
    data.edge = median_edge(data);
    constexpr double is_long = 1.5; // in median border edges
    if (range.long_edges) divide_long_edges(data, is_long * data.edge, 3 * data.edge);
    find_normals(data);
    return data;
}

} // namespace terrane
