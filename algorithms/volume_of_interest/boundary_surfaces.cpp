// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/arrangement/soup.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/cosine_and_sine.hpp>
#include <terrane/algorithms/mesh/edges.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/search/search.hpp>
#include <terrane/algorithms/triangulation/triangulation.hpp>
#include <terrane/algorithms/volume_of_interest/detail/constants.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {
namespace {

constexpr std::size_t most_named_sides =
    volume_of_interest::detail::boundary_tuning.most_named_sides;

/// Builds a closed body from two rings of corners, counterclockwise seen from above, and the
/// triangulation of one ring.
std::vector<Surface> prism(std::span<const Point3> bottom, std::span<const Point3> top,
                           std::span<const Triangle> cap) {
    std::vector<Surface> surfaces;
    const auto add = [&](std::string name) -> Surface& {
        return surfaces.emplace_back(Surface{std::move(name), Role::boundary, {}, {}});
    };
    Surface& lid = add("boundary top");
    lid.vertices.assign(top.begin(), top.end());
    lid.triangles.assign(cap.begin(), cap.end());
    Surface& floor = add("boundary bottom");
    floor.vertices.assign(bottom.begin(), bottom.end());
    for (const Triangle& t : cap) floor.triangles.push_back({t[0], t[2], t[1]});
    const std::size_t n = top.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (i == 0 || n <= most_named_sides)
            add(n <= most_named_sides ? fmt::format("boundary side {}", i + 1) : "boundary sides");
        Surface& side = surfaces.back();
        const auto first = static_cast<std::uint32_t>(side.vertices.size());
        const std::size_t next = (i + 1) % n;
        side.vertices.insert(side.vertices.end(), {bottom[i], bottom[next], top[next], top[i]});
        side.triangles.push_back({first, first + 1, first + 2});
        side.triangles.push_back({first, first + 2, first + 3});
    }
    return surfaces;
}

// ---- Polygons

Point3 flat(const Point2& p) {
    return {p[0], p[1], 0};
}

/// A simple polygon that can be triangulated.
class Polygon {
public:
    explicit Polygon(std::span<const Point2> corners) {
        for (const Point2& p : corners) corners_.push_back(flat(p));
        if (corners_.size() > 1 && corners_.front() == corners_.back()) corners_.pop_back();
    }

    [[nodiscard]] std::span<const Point3> corners() const { return corners_; }
    [[nodiscard]] std::optional<Error> flaw() const;
    void turn_counterclockwise();
    /// Triangulates the polygon, counterclockwise; it must be simple.
    [[nodiscard]] std::vector<Triangle> triangles() const;

private:
    [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % corners_.size(); }
    [[nodiscard]] Sign orientation(std::size_t a, std::size_t b, std::size_t c) const {
        return orient2d(Axis::z, corners_[a], corners_[b], corners_[c]);
    }
    [[nodiscard]] bool meet(std::size_t e, std::size_t f) const;

    std::vector<Point3> corners_; ///< z = 0
};

/// Tells whether two edges, whose boxes overlap, meet other than in their common corner.
bool Polygon::meet(std::size_t e, std::size_t f) const {
    if (next(f) == e) std::swap(e, f);
    const std::size_t e1 = next(e), f1 = next(f);
    if (e1 == f) { // f follows e: they share more than the corner if f runs back
        const bool in_line = orientation(e, e1, f1) == Sign::Zero;
        return in_line && (corners_[e] < corners_[e1]) == (corners_[f1] < corners_[e1]);
    }
    const Sign a = orientation(e, e1, f), b = orientation(e, e1, f1);
    if (a == b && a != Sign::Zero) return false;
    const Sign c = orientation(f, f1, e), d = orientation(f, f1, e1);
    return c != d || c == Sign::Zero; // collinear edges whose boxes overlap share a point
}

std::optional<Error> Polygon::flaw() const {
    const auto name = [&](std::size_t e) {
        const Point3 &a = corners_[e], &b = corners_[next(e)];
        return fmt::format("edge {} from ({}, {}) to ({}, {})", e + 1, a.x, a.y, b.x, b.y);
    };
    for (std::size_t i = 0; i < corners_.size(); ++i)
        if (!is_finite(corners_[i]))
            return Error{ErrorCode::bad_number, "is not finite", fmt::format("corner {}", i + 1)};
    if (corners_.size() < 3)
        return Error{ErrorCode::bad_option, "a polygon needs three corners", "polygon"};
    std::vector<Box> boxes;
    for (std::size_t e = 0; e < corners_.size(); ++e) {
        const Point3 &a = corners_[e], &b = corners_[next(e)];
        if (a == b)
            return Error{ErrorCode::improper_contact, name(e) + " has no length", "polygon"};
        boxes.push_back({{std::min(a.x, b.x), std::min(a.y, b.y), 0},
                         {std::max(a.x, b.x), std::max(a.y, b.y), 0}});
    }
    for (const CandidatePair& p : candidate_pairs(boxes, {}, Search::automatic))
        if (meet(p.first, p.second))
            return Error{ErrorCode::improper_contact,
                         "the polygon meets itself: " + name(p.first) + " and " + name(p.second),
                         "polygon"};
    return std::nullopt;
}

/// A simple polygon turns left at its least corner, unless it is clockwise. The least corner is
/// never collinear with its neighbours, as the polygon would run back there.
void Polygon::turn_counterclockwise() {
    const auto least = static_cast<std::size_t>(std::min_element(corners_.begin(), corners_.end()) -
                                                corners_.begin());
    const std::size_t before = (least + corners_.size() - 1) % corners_.size();
    if (orientation(before, least, next(least)) == Sign::Negative)
        std::reverse(corners_.begin(), corners_.end());
}

/// Returns a triangle strictly around all points.
std::array<Point3, 3> triangle_around(std::span<const Point3> points) {
    Point3 low = points[0], high = points[0];
    for (const Point3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
    }
    const double w = std::max(high.x - low.x, high.y - low.y);
    return {Point3{low.x - 4 * w, low.y - w, 0}, Point3{high.x + 4 * w, low.y - w, 0},
            Point3{low.x + (high.x - low.x) / 2, high.y + 4 * w, 0}};
}

std::vector<std::uint32_t> ranks_of(std::span<const Point3> points) {
    std::vector<std::uint32_t> order(points.size()), rank(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return points[i] < points[j]; });
    for (std::uint32_t r = 0; r < order.size(); ++r) rank[order[r]] = r;
    return rank;
}

/// Selects the triangles that are separated by segments from those at the first three points.
std::vector<Triangle> enclosed(const std::vector<Triangle>& all, std::size_t points,
                               std::vector<Edge> segments) {
    for (Edge& s : segments)
        if (s[0] > s[1]) std::swap(s[0], s[1]);
    std::sort(segments.begin(), segments.end());
    DisjointSets sets(all.size() + 1); // the last one is the outside
    const auto outside = static_cast<std::uint32_t>(all.size());
    for (std::uint32_t t = 0; t < all.size(); ++t)
        if (all[t][0] < 3 || all[t][1] < 3 || all[t][2] < 3) sets.join(t, outside);
    group_edges(all, points).for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (sides.size() == 2 &&
            !std::binary_search(segments.begin(), segments.end(), Edge{low, high}))
            sets.join(sides[0].triangle, sides[1].triangle);
    });
    std::vector<Triangle> inside;
    for (std::uint32_t t = 0; t < all.size(); ++t)
        if (sets.find(t) != sets.find(outside)) inside.push_back(all[t]);
    return inside;
}

std::vector<Triangle> Polygon::triangles() const {
    const auto around = triangle_around(corners_);
    std::vector<Point3> points(around.begin(), around.end());
    points.insert(points.end(), corners_.begin(), corners_.end());
    FaceInput face;
    face.corners = {0, 1, 2};
    std::vector<Edge> segments;
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
        face.inner_points.push_back(i + 3);
        face.segments.push_back({i + 3, static_cast<std::uint32_t>(next(i)) + 3});
        segments.push_back(face.segments.back());
    }
    const auto rank = ranks_of(points);
    const PointStore store(points);
    const UpwardRounding guard;
    FaceTriangulation triangulate(guard);
    const auto made = triangulate(store, rank, face);
    auto inside = enclosed({made.begin(), made.end()}, points.size(), std::move(segments));
    for (Triangle& t : inside)
        for (std::uint32_t& v : t) v -= 3;
    return inside;
}

// ---- Rotation

/// Returns the directions across, along and up.
std::array<Point3, 3> axes_of(const RotatedBox& box) {
    const auto [ca, sa] = cosine_and_sine(box.azimuth);
    const auto [cp, sp] = cosine_and_sine(box.plunge);
    const auto [cr, sr] = cosine_and_sine(box.roll);
    const Point3 along{sa * cp, ca * cp, -sp};
    const Point3 right{ca, -sa, 0};        // before the roll
    const Point3 up{sa * sp, ca * sp, cp}; // right x along
    return {Point3{cr * right.x - sr * up.x, cr * right.y - sr * up.y, cr * right.z - sr * up.z},
            along,
            Point3{cr * up.x + sr * right.x, cr * up.y + sr * right.y, cr * up.z + sr * right.z}};
}

/// Returns the corner at these shares of the edges: from -1/2 to 1/2 about the centre, or 0 to 1.
Point3 corner_at(const RotatedBox& box, const std::array<Point3, 3>& axes,
                 const std::array<double, 3>& shares) {
    Point3 p = box.place;
    for (unsigned k = 0; k < 3; ++k) {
        const double d = shares[k] * box.lengths[k];
        p = {p.x + d * axes[k].x, p.y + d * axes[k].y, p.z + d * axes[k].z};
    }
    return p;
}

/// Describes where two triangles of the boundary meet improperly.
Error contact_error(const CheckReport& report, std::span<const Surface> surfaces) {
    const ImproperContact& c = report.contacts.front();
    const auto name = [&](std::uint32_t t) {
        const auto& first = report.first_triangle;
        const auto s = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), t) -
                                                first.begin() - 1);
        return fmt::format("{} triangle {}", surfaces[s].name, t - first[s]);
    };
    return {ErrorCode::improper_contact,
            fmt::format("the boundary meets itself: {} and {}, {}", name(c.triangles[0]),
                        name(c.triangles[1]), name_of(c.kind)),
            place_text(c.place)};
}

/// Finds an edge at which the boundary is open or a wall inside of it ends.
std::optional<Error> open_edge(std::span<const Surface> surfaces, const Run& run) {
    const Soup soup = merge_surfaces(surfaces, run);
    if (soup.triangles.empty())
        return Error{ErrorCode::nothing_to_do, "has no triangle with area", "boundary"};
    std::optional<Error> found;
    soup.edges.for_each([&](std::uint32_t low, std::uint32_t high, auto sides) {
        if (found || sides.size() % 2 == 0) return;
        found = Error{ErrorCode::not_closed,
                      fmt::format("the boundary is not closed: {} {} the edge to {}", sides.size(),
                                  sides.size() == 1 ? "triangle has" : "triangles have",
                                  place_text(soup.points[high])),
                      place_text(soup.points[low])};
    });
    return found;
}

/// Whether doubles hold the volume and the areas of the box around all vertices, and sums of some.
bool can_be_measured(std::span<const Surface> surfaces) {
    constexpr double infinite = std::numeric_limits<double>::infinity(), terms = 16;
    Point3 low{infinite, infinite, infinite}, high{-infinite, -infinite, -infinite};
    for (const Surface& s : surfaces)
        for (const Point3& p : s.vertices) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    if (low.x > high.x) return true; // there is none
    const double x = terms * (high.x - low.x), y = high.y - low.y, z = high.z - low.z;
    return std::isfinite(x * y) && std::isfinite(x * z) && std::isfinite(terms * y * z) &&
           std::isfinite(x * y * z);
}

} // namespace

Result<std::vector<Surface>> closed_boundary(std::span<const Surface> surfaces, const Run& run) {
    return guarded("for the boundary", "boundary", [&]() -> Result<std::vector<Surface>> {
        const auto report = check(surfaces, run);
        if (!report) return report.error();
        if (!can_be_measured(surfaces))
            return Error{ErrorCode::bad_number, "doubles cannot hold its volume", "boundary"};
        if (const auto open = open_edge(surfaces, run)) return *open;
        if (!report.value().contacts.empty()) return contact_error(report.value(), surfaces);
        if (!report.value().repeated.empty() || !report.value().shared.empty())
            return Error{ErrorCode::improper_contact, "the boundary has a triangle twice",
                         "boundary"};
        std::vector<Surface> boundary(surfaces.begin(), surfaces.end());
        for (Surface& s : boundary) s.role = Role::boundary;
        return boundary;
    });
}

Result<std::vector<Surface>> box_boundary(const Point3& low, const Point3& high) {
    return guarded("for the boundary", "boundary", [&]() -> Result<std::vector<Surface>> {
        if (!is_finite(low) || !is_finite(high))
            return Error{ErrorCode::bad_number, "a corner is not finite", "box"};
        if (!(low.x < high.x && low.y < high.y && low.z < high.z))
            return Error{ErrorCode::bad_option, "the first corner must be below the second one",
                         "box"};
        const std::array<Point2, 4> ring{Point2{low.x, low.y}, Point2{high.x, low.y},
                                         Point2{high.x, high.y}, Point2{low.x, high.y}};
        auto sides = polygon_boundary(ring, low.z, high.z);
        if (!sides && sides.error().code == ErrorCode::bad_number)
            return Error{ErrorCode::bad_number, "the box is too large for doubles", "box"};
        return sides;
    });
}

Result<std::vector<Surface>> rotated_box_boundary(const RotatedBox& box) {
    return guarded("for the boundary", "boundary", [&]() -> Result<std::vector<Surface>> {
        for (const double length : box.lengths)
            if (!(length > 0))
                return Error{ErrorCode::bad_option, "the lengths of its edges must be positive",
                             "rotated box"};
        for (const double degrees : {box.azimuth, box.plunge, box.roll})
            if (!(std::fabs(degrees) <= 360))
                return Error{ErrorCode::bad_option, "its angles must be from -360 to 360 degrees",
                             "rotated box"};
        const auto axes = axes_of(box);
        const double low = box.is_corner ? 0 : -0.5, high = box.is_corner ? 1 : 0.5;
        const auto ring = [&](double level) {
            return std::array{corner_at(box, axes, {low, low, level}),
                              corner_at(box, axes, {high, low, level}),
                              corner_at(box, axes, {high, high, level}),
                              corner_at(box, axes, {low, high, level})};
        };
        const auto bottom = ring(low), top = ring(high);
        for (const auto& corners : {bottom, top})
            for (const Point3& p : corners)
                if (!is_finite(p))
                    return Error{ErrorCode::bad_number, "a corner is not finite", "rotated box"};
        const std::array cap{Triangle{0, 1, 2}, Triangle{0, 2, 3}};
        auto sides = closed_boundary(prism(bottom, top, cap));
        if (!sides && sides.error().code == ErrorCode::bad_number)
            return Error{ErrorCode::bad_number, "the box is too large for doubles", "rotated box"};
        return sides;
    });
}

Result<std::vector<Surface>> polygon_boundary(std::span<const Point2> corners, double low,
                                              double high) {
    return guarded("for the boundary", "boundary", [&]() -> Result<std::vector<Surface>> {
        if (!std::isfinite(low) || !std::isfinite(high))
            return Error{ErrorCode::bad_number, "a depth is not finite", "polygon"};
        if (low == high) return Error{ErrorCode::bad_option, "the two depths are equal", "polygon"};
        Polygon polygon(corners);
        if (const auto flaw = polygon.flaw()) return *flaw;
        const auto around = triangle_around(polygon.corners());
        if (!std::all_of(around.begin(), around.end(), is_finite))
            return Error{ErrorCode::bad_number, "the polygon is too large for doubles", "polygon"};
        polygon.turn_counterclockwise();
        std::vector<Point3> bottom, top;
        for (const Point3& p : polygon.corners()) {
            bottom.push_back({p.x, p.y, std::min(low, high)});
            top.push_back({p.x, p.y, std::max(low, high)});
        }
        return closed_boundary(prism(bottom, top, polygon.triangles()));
    });
}

std::vector<NamedConstant> boundary_constants() {
    return {{"most_named_sides", static_cast<double>(most_named_sides)}};
}

} // namespace terrane
