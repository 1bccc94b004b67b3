// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/triangulation/planar.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/triangulation/detail/constants.hpp>
#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr double largest = 1e300;
constexpr double surroundings = triangulation::detail::constants.surroundings;

using EdgeList = std::vector<std::array<std::uint32_t, 2>>;

Error interrupted() {
    return {ErrorCode::interrupted, "interrupted", ""};
}

bool before(const Point3& a, const Point3& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}
bool same_place(const Point3& a, const Point3& b) {
    return a.x == b.x && a.y == b.y;
}

Status check_numbers(std::span<const Point3> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!(std::abs(points[i].x) <= largest && std::abs(points[i].y) <= largest))
            return Error{ErrorCode::bad_number, "a coordinate is beyond 1e300 or not finite",
                         fmt::format("point {}", i)};
    return Done{};
}

/// Returns the points sorted by their place in the plane; points at one place stay in order.
std::vector<std::uint32_t> sorted(std::span<const Point3> points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return same_place(points[a], points[b]) ? a < b : before(points[a], points[b]);
    });
    return order;
}

/// Returns the corners of a triangle that contains all points at a large distance.
std::array<Point3, 3> corners_round(std::span<const Point3> points) {
    Point3 low = points[0], high = low;
    for (const Point3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    const double size = std::max(high.x - low.x, high.y - low.y);
    const double far = std::max(surroundings * size, std::ldexp(1.0, -1000));
    const double x = low.x + (high.x - low.x) / 2, y = low.y + (high.y - low.y) / 2;
    return {Point3{x - 2 * far, y - far, 0}, Point3{x + 2 * far, y - far, 0},
            Point3{x, y + 2 * far, 0}};
}

/// Triangulates the points in a large triangle whose corners have the three indices from
/// points.size() on, and returns all cells.
std::vector<Triangle> cells_of(std::span<const Point3> points,
                               std::span<const std::uint32_t> in_use, const EdgeList& edges) {
    std::vector<Point3> all(points.begin(), points.end());
    const auto corners = corners_round(points);
    all.insert(all.end(), corners.begin(), corners.end());
    const auto count = static_cast<std::uint32_t>(points.size());
    std::vector<std::uint32_t> order(in_use.begin(), in_use.end());
    order.insert(order.end(), {count, count + 1, count + 2});
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return before(all[a], all[b]); });
    std::vector<std::uint32_t> rank(all.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;

    FaceInput face;
    face.corners = {count, count + 1, count + 2};
    face.inner_points.assign(in_use.begin(), in_use.end());
    face.segments.assign(edges.begin(), edges.end());
    const PointStore store(std::move(all));
    const UpwardRounding guard;
    FaceTriangulation triangulate(guard);
    const auto cells = triangulate(store, rank, face);
    return {cells.begin(), cells.end()};
}

/// Rotates a triangle so that its lowest corner comes first. The result then does not depend on the
/// order in which cells were made.
Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

bool overlap(double a, double b, double c, double d) {
    return std::max(std::min(a, b), std::min(c, d)) <= std::min(std::max(a, b), std::max(c, d));
}

/// Whether two edges meet other than at an angle in a common corner.
bool meet_improperly(std::span<const Point3> points, std::array<std::uint32_t, 2> e,
                     std::array<std::uint32_t, 2> f) {
    for (int turn = 0; turn < 2; ++turn, std::swap(e[0], e[1]))
        if (e[0] == f[0] || e[0] == f[1]) {
            const Point3 &common = points[e[0]], &a = points[e[1]];
            const Point3& b = points[e[0] == f[0] ? f[1] : f[0]];
            if (orient2d(Axis::z, common, a, b) != Sign::Zero) return false;
            return before(common, a) == before(common, b); // on one ray
        }
    const Point3 &a = points[e[0]], &b = points[e[1]], &c = points[f[0]], &d = points[f[1]];
    if (!overlap(a.x, b.x, c.x, d.x) || !overlap(a.y, b.y, c.y, d.y)) return false;
    return orient2d(Axis::z, a, b, c) * orient2d(Axis::z, a, b, d) != Sign::Positive &&
           orient2d(Axis::z, c, d, a) * orient2d(Axis::z, c, d, b) != Sign::Positive;
}

Error contact_at(const Point3& p, std::string_view what) {
    return {ErrorCode::improper_contact, std::string(what), fmt::format("({}, {})", p.x, p.y)};
}

/// Returns how many edges a line across `axis` meets on average, up to a factor.
double edges_across(std::span<const Point3> points, const EdgeList& edges, double Point3::*axis) {
    double low = points[edges[0][0]].*axis, high = low, sum = 0;
    for (const auto& [a, b] : edges) {
        low = std::min({low, points[a].*axis, points[b].*axis});
        high = std::max({high, points[a].*axis, points[b].*axis});
        sum += std::abs(points[a].*axis - points[b].*axis);
    }
    return high > low ? sum / (high - low) : static_cast<double>(edges.size());
}

/// Returns a point at which edges meet improperly, found by a sweep along x.
std::optional<std::uint32_t> contact_of(std::span<const Point3> points, EdgeList edges) {
    for (auto& e : edges)
        if (before(points[e[1]], points[e[0]])) std::swap(e[0], e[1]);
    std::sort(edges.begin(), edges.end(), [&](const auto& e, const auto& f) {
        return points[e[0]].x != points[f[0]].x ? points[e[0]].x < points[f[0]].x : e < f;
    });
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            if (points[edges[j][0]].x > points[edges[i][1]].x) break;
            if (meet_improperly(points, edges[i], edges[j])) return edges[j][0];
        }
    return std::nullopt;
}

/// Checks that no two edges meet improperly, by a sweep along the axis along which fewer of them are
/// side by side: y only where these are far fewer.
Status check_contacts(std::span<const Point3> points, const EdgeList& edges) {
    std::vector<Point3> turned;
    if (4 * edges_across(points, edges, &Point3::y) < edges_across(points, edges, &Point3::x))
        for (const Point3& p : points) turned.push_back({p.y, -p.x, 0});
    const auto contact = contact_of(turned.empty() ? points : turned, edges);
    if (!contact) return Done{};
    return contact_at(points[*contact], "seen from above, the border crosses or touches itself");
}

/// Selects the cells that an odd number of polygons surround, by a flood fill from a far corner.
class Diffusion {
public:
    Diffusion(const std::vector<Triangle>& cells, std::uint32_t corner, EdgeList borders) :
        cells_(cells), borders_(std::move(borders)), inside_(cells.size()), seen_(cells.size()) {
        for (auto& e : borders_)
            if (e[0] > e[1]) std::swap(e[0], e[1]);
        std::sort(borders_.begin(), borders_.end());
        connect(corner + 3);
        const auto has_corner = [&](const Triangle& t) {
            return std::find(t.begin(), t.end(), corner) != t.end();
        };
        const auto first = std::find_if(cells_.begin(), cells_.end(), has_corner);
        spread(static_cast<std::uint32_t>(first - cells_.begin()));
    }

    [[nodiscard]] std::vector<Triangle> result() const {
        std::vector<Triangle> kept;
        for (std::size_t c = 0; c < cells_.size(); ++c)
            if (inside_[c]) kept.push_back(turned(cells_[c]));
        std::sort(kept.begin(), kept.end());
        return kept;
    }

private:
    struct Neighbour {
        std::uint32_t cell;
        bool beyond; ///< on the other side of a polygon's edge
    };

    void connect(std::size_t vertex_count) {
        neighbours_.resize(cells_.size());
        const auto grouped = group_edges(cells_, vertex_count);
        grouped.for_each([&](std::uint32_t low, std::uint32_t high, const auto& sides) {
            if (sides.size() != 2) return;
            const bool border =
                std::binary_search(borders_.begin(), borders_.end(), std::array{low, high});
            neighbours_[sides[0].triangle].push_back({sides[1].triangle, border});
            neighbours_[sides[1].triangle].push_back({sides[0].triangle, border});
        });
    }

    void spread(std::uint32_t first) {
        std::vector<std::uint32_t> todo{first};
        seen_[first] = true;
        while (!todo.empty()) {
            const auto c = todo.back();
            todo.pop_back();
            for (const auto& [cell, beyond] : neighbours_[c]) {
                if (seen_[cell]) continue;
                seen_[cell] = true;
                inside_[cell] = inside_[c] != beyond;
                todo.push_back(cell);
            }
        }
    }

    const std::vector<Triangle>& cells_;
    EdgeList borders_; ///< lower vertex first, sorted
    std::vector<bool> inside_, seen_;
    std::vector<std::vector<Neighbour>> neighbours_;
};

} // namespace

Result<std::vector<Triangle>> delaunay(std::span<const Point3> points, const Run& run) {
    if (const auto status = check_numbers(points); !status) return status.error();
    if (run.stop.stop_requested()) return interrupted();
    auto in_use = sorted(points);
    const auto same = [&](std::uint32_t a, std::uint32_t b) {
        return same_place(points[a], points[b]);
    };
    in_use.erase(std::unique(in_use.begin(), in_use.end(), same), in_use.end());
    if (in_use.size() < 3) return std::vector<Triangle>{};
    const auto count = static_cast<std::uint32_t>(points.size());
    std::vector<Triangle> triangles;
    for (const Triangle& cell : cells_of(points, in_use, {}))
        if (std::max({cell[0], cell[1], cell[2]}) < count) triangles.push_back(turned(cell));
    if (run.stop.stop_requested()) return interrupted();
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

Result<std::vector<Triangle>> triangulate_inside(std::span<const Point3> points,
                                                 std::span<const Polygon> polygons,
                                                 const Run& run) {
    if (const auto status = check_numbers(points); !status) return status.error();
    const auto in_use = sorted(points);
    for (std::size_t i = 1; i < in_use.size(); ++i)
        if (same_place(points[in_use[i - 1]], points[in_use[i]]))
            return contact_at(points[in_use[i]], "seen from above, two points coincide");
    EdgeList edges;
    for (const Polygon& polygon : polygons)
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const auto next = polygon[(i + 1) % polygon.size()];
            if (polygon[i] >= points.size() || next >= points.size() || next == polygon[i])
                return Error{ErrorCode::bad_index, "a polygon names no points, or one twice",
                             fmt::format("corner {}", i)};
            edges.push_back({polygon[i], next});
        }
    if (edges.empty()) return std::vector<Triangle>{};
    if (const auto status = check_contacts(points, edges); !status) return status.error();
    if (run.stop.stop_requested()) return interrupted();
    const auto cells = cells_of(points, in_use, edges);
    return Diffusion(cells, static_cast<std::uint32_t>(points.size()), std::move(edges)).result();
}

} // namespace terrane
