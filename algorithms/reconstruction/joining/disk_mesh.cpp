// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/reconstruction/joining/disk_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/mesh/vectors.hpp>
#include <terrane/algorithms/reconstruction/joining/detail/constants.hpp>

namespace terrane {
namespace {

using joining::detail::constants;

/// Dynamic program for the best triangulation of a polygon: the worst shape between corners i and
/// j.
struct Table {
    explicit Table(std::size_t count) :
        sides(count), worst(count * count, std::numeric_limits<double>::infinity()),
        apex(count * count, 0) {}
    [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return i * sides + j; }

    std::size_t sides;
    std::vector<double> worst;       ///< infinite where nothing needs to be filled
    std::vector<std::uint32_t> apex; ///< third corner of the triangle on side i j
};

void collect(const Table& table, std::span<const std::uint32_t> polygon, std::size_t i,
             std::size_t j, std::vector<Triangle>& made) {
    std::vector<std::array<std::size_t, 2>> open{{i, j}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        if (b - a < 2) continue;
        const std::size_t m = table.apex[table.at(a, b)];
        made.push_back({polygon[a], polygon[m], polygon[b]});
        open.push_back({m, b});
        open.push_back({a, m});
    }
}

} // namespace

double shape(const Point3& a, const Point3& b, const Point3& c, const Point3& direction) {
    const Point3 u = minus(b, a), v = minus(c, a), w = minus(c, b);
    const Point3 normal = cross(u, v);
    const double squares = dot(u, u) + dot(v, v) + dot(w, w);
    if (!(squares > 0)) return 0;
    const double size = 2 * std::sqrt(3.0) * std::sqrt(dot(normal, normal)) / squares;
    return dot(normal, direction) > 0 ? size : -size;
}

DiskMesh::DiskMesh(std::vector<Point3> points, std::vector<Triangle> triangles,
                   std::vector<Edge> taken) :
    points_(std::move(points)),
    taken_(std::move(taken)), triangles_(std::move(triangles)), alive_(triangles_.size(), true),
    star_(points_.size()) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (const std::uint32_t v : triangles_[t]) star_[v].push_back(t);
}

std::vector<Triangle> DiskMesh::triangles() const {
    std::vector<Triangle> living;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (alive_[t]) living.push_back(triangles_[t]);
    return living;
}

std::vector<std::uint32_t> DiskMesh::neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : star_[v])
        for (const std::uint32_t w : triangles_[t])
            if (w != v) found.push_back(w);
    sort_unique(found);
    return found;
}

std::ptrdiff_t DiskMesh::triangles_at(std::uint32_t a, std::uint32_t b) const {
    return std::count_if(star_[a].begin(), star_[a].end(), [&](std::uint32_t t) {
        const Triangle& c = triangles_[t];
        return c[0] == b || c[1] == b || c[2] == b;
    });
}

bool DiskMesh::has_edge(std::uint32_t a, std::uint32_t b) const {
    return triangles_at(a, b) > 0 ||
           std::binary_search(taken_.begin(), taken_.end(), Edge{std::min(a, b), std::max(a, b)});
}

Point3 DiskMesh::normal_of(std::span<const std::uint32_t> triangles) const {
    Point3 sum;
    for (const std::uint32_t t : triangles) {
        const Triangle& c = triangles_[t];
        const Point3 n =
            cross(minus(points_[c[1]], points_[c[0]]), minus(points_[c[2]], points_[c[0]]));
        sum = {sum.x + n.x, sum.y + n.y, sum.z + n.z};
    }
    return sum;
}

std::optional<DiskMesh::Link> DiskMesh::link_of(std::uint32_t v) const {
    std::vector<std::array<std::uint32_t, 2>> sides; // opposite to v, oriented as in the triangle
    for (const std::uint32_t t : star_[v]) {
        const Triangle& c = triangles_[t];
        const unsigned i = c[0] == v ? 0 : c[1] == v ? 1 : 2;
        sides.push_back({c[(i + 1) % 3], c[(i + 2) % 3]});
    }
    if (sides.empty()) return std::nullopt;
    std::size_t first = 0; // the side that no other leads to; any side of a closed link
    const auto leads_to = [&](std::uint32_t w) {
        return std::find_if(sides.begin(), sides.end(), [&](const auto& s) { return s[1] == w; });
    };
    Link link;
    link.closed = true;
    for (std::size_t s = 0; s < sides.size(); ++s)
        if (leads_to(sides[s][0]) == sides.end()) {
            first = s;
            link.closed = false;
        }
    link.vertices = {sides[first][0], sides[first][1]};
    while (link.vertices.size() <= sides.size()) {
        const auto next = std::find_if(sides.begin(), sides.end(),
                                       [&](const auto& s) { return s[0] == link.vertices.back(); });
        if (next == sides.end()) break;
        link.vertices.push_back((*next)[1]);
    }
    if (link.vertices.size() != sides.size() + 1) return std::nullopt; // several fans
    if (link.closed) link.vertices.pop_back();
    return link;
}

std::optional<std::vector<Triangle>> DiskMesh::fill(std::uint32_t v, const Link& link) const {
    const auto& polygon = link.vertices;
    const std::size_t n = polygon.size();
    if (n > constants.most_sides) return std::nullopt;
    if (n == 2) // a single border triangle is removed; the edge opposite to v keeps its other
                // triangle
        return triangles_at(polygon[0], polygon[1]) == 2 ? std::optional(std::vector<Triangle>{})
                                                         : std::nullopt;
    const Point3 normal = normal_of(star_[v]);
    // A diagonal that already is an edge outside of the star would get a third triangle.
    const auto is_taken = [&](std::size_t i, std::size_t j) {
        const bool side = j == i + 1 || (link.closed && i == 0 && j + 1 == n);
        return !side && has_edge(polygon[i], polygon[j]);
    };
    Table table(n);
    for (std::size_t width = 2; width < n; ++width)
        for (std::size_t i = 0; i + width < n; ++i) {
            const std::size_t j = i + width;
            double best = -std::numeric_limits<double>::infinity();
            for (std::size_t m = i + 1; m < j && !is_taken(i, j); ++m) {
                const double worst = std::min(
                    {shape(points_[polygon[i]], points_[polygon[m]], points_[polygon[j]], normal),
                     table.worst[table.at(i, m)], table.worst[table.at(m, j)]});
                if (worst > best) {
                    best = worst;
                    table.apex[table.at(i, j)] = static_cast<std::uint32_t>(m);
                }
            }
            table.worst[table.at(i, j)] = best;
        }
    if (!(table.worst[table.at(0, n - 1)] > 0)) return std::nullopt;
    std::vector<Triangle> made;
    collect(table, polygon, 0, n - 1, made);
    return made;
}

bool DiskMesh::is_at_border(std::uint32_t v) const {
    const auto link = link_of(v);
    return !link || !link->closed;
}

bool DiskMesh::move_if_sound(std::uint32_t v, const Point3& to, double sound) {
    const Point3 normal = normal_of(star_[v]);
    const auto worst = [&] {
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t t : star_[v]) {
            const Triangle& c = triangles_[t];
            least = std::min(least, shape(points_[c[0]], points_[c[1]], points_[c[2]], normal));
        }
        return least;
    };
    const double before = worst();
    const Point3 from = points_[v];
    points_[v] = to;
    const double after = worst();
    if (after > 0 && (after >= before || after >= sound)) return true;
    points_[v] = from;
    return false;
}

void DiskMesh::add(const Triangle& t) {
    const auto index = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(t);
    alive_.push_back(true);
    for (const std::uint32_t v : t) star_[v].push_back(index);
}

void DiskMesh::erase(std::uint32_t triangle) {
    alive_[triangle] = false;
    for (const std::uint32_t v : triangles_[triangle]) std::erase(star_[v], triangle);
}

bool DiskMesh::remove(std::uint32_t v) {
    const auto link = link_of(v);
    if (!link) return false;
    const auto made = fill(v, *link);
    if (!made) return false;
    const std::vector<std::uint32_t> old = star_[v];
    for (const std::uint32_t t : old) erase(t);
    for (const Triangle& t : *made) add(t);
    return true;
}

bool DiskMesh::swap(std::uint32_t a, std::uint32_t b) {
    std::vector<std::uint32_t> sides;
    for (const std::uint32_t t : star_[a]) {
        const Triangle& c = triangles_[t];
        if (c[0] == b || c[1] == b || c[2] == b) sides.push_back(t);
    }
    if (sides.size() != 2) return false;
    const auto third = [&](std::uint32_t t) {
        const Triangle& c = triangles_[t];
        return c[0] != a && c[0] != b ? c[0] : c[1] != a && c[1] != b ? c[1] : c[2];
    };
    const auto follows = [&](std::uint32_t t) { // a before b, in the triangle's direction
        const Triangle& c = triangles_[t];
        return c[0] == a ? c[1] == b : c[1] == a ? c[2] == b : c[0] == b;
    };
    if (!follows(sides[0])) std::swap(sides[0], sides[1]);
    const std::uint32_t left = third(sides[0]), right = third(sides[1]);
    if (left == right || has_edge(left, right)) return false;
    const Point3 normal = normal_of(sides);
    const auto& p = points_;
    const double before =
        std::min(shape(p[a], p[b], p[left], normal), shape(p[b], p[a], p[right], normal));
    const double after =
        std::min(shape(p[a], p[right], p[left], normal), shape(p[right], p[b], p[left], normal));
    if (!(after > 0) || after <= before + constants.least_swap_gain) return false;
    const std::array<std::uint32_t, 2> old{sides[0], sides[1]};
    for (const std::uint32_t t : old) erase(t);
    add({a, right, left});
    add({right, b, left});
    return true;
}

std::size_t DiskMesh::improve(std::span<const std::uint32_t> vertices) {
    std::size_t swapped = 0;
    for (unsigned pass = 0; pass < constants.most_swap_passes; ++pass) {
        const std::size_t before = swapped;
        for (const std::uint32_t a : vertices)
            for (const std::uint32_t b : neighbours(a)) swapped += swap(a, b) ? 1 : 0;
        if (swapped == before) break;
    }
    return swapped;
}

} // namespace terrane
