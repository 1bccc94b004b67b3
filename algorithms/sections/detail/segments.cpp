// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/detail/segments.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include <terrane/algorithms/mesh/median_tree.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::sections {
namespace {

constexpr std::uint32_t most_in_leaf = 8;

using ThreePoints = std::array<Point3, 3>;
using ExactPoint = polynomial::Coordinates<Exact, Exact>;

auto exact(const Point3& p) {
    return polynomial::cartesian<Exact>(p);
}

ThreePoints corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [i, j, k] = mesh.triangles[triangle];
    return {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]};
}

/// Returns above / below, where below is not 0.
Share share_of(const Exact& above, const Exact& below) {
    return exact_sign(below) == Sign::Negative ? Share{-above, -below} : Share{above, below};
}

/// Finds the part of a segment in a triangle in whose plane it lies.
std::optional<SegmentContact> contact_in_plane(const PathSegment& s, const ThreePoints& t) {
    if (collinear(t[0], t[1], t[2])) return std::nullopt;
    const Axis axis = projection_axis(t[0], t[1], t[2]);
    const bool turns_left = orient2d(axis, t[0], t[1], t[2]) == Sign::Positive;
    SegmentContact contact{Share{}, Share{Exact(1.0), Exact(1.0)}};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto p = exact(t[i]), q = exact(t[(i + 1) % 3]);
        const auto inwards = [&](const Point3& end) {
            const Exact left = polynomial::orient2d(axis, p, q, exact(end));
            return turns_left ? left : -left;
        };
        const Exact at_a = inwards(s.a), growth = inwards(s.b) - at_a;
        const Sign grows = exact_sign(growth);
        if (grows == Sign::Zero) {
            if (exact_sign(at_a) == Sign::Negative) return std::nullopt;
            continue;
        }
        const Share zero = share_of(-at_a, growth);
        if (grows == Sign::Positive)
            contact.from = std::max(contact.from, zero);
        else
            contact.to = std::min(contact.to, zero);
    }
    if (contact.to < contact.from) return std::nullopt;
    return contact;
}

std::optional<SegmentContact> contact_of(const PathSegment& s, const ThreePoints& t) {
    const Sign a = orient3d(t[0], t[1], t[2], s.a), b = orient3d(t[0], t[1], t[2], s.b);
    if (a == b) return a == Sign::Zero ? contact_in_plane(s, t) : std::nullopt;
    const std::array turns{orient3d(s.a, s.b, t[0], t[1]), orient3d(s.a, s.b, t[1], t[2]),
                           orient3d(s.a, s.b, t[2], t[0])};
    const auto has = [&](Sign sign) { return std::ranges::count(turns, sign) > 0; };
    if (has(Sign::Positive) && has(Sign::Negative)) return std::nullopt;
    const auto height = [&](const Point3& p) {
        return polynomial::orient3d(exact(t[0]), exact(t[1]), exact(t[2]), exact(p));
    };
    const Exact at_a = height(s.a);
    const Share at = share_of(at_a, at_a - height(s.b));
    return SegmentContact{at, at, 0, !has(Sign::Zero), a, b};
}

ExactPoint point_at(const PathSegment& s, const Share& share) {
    const auto a = exact(s.a), b = exact(s.b);
    const auto at = [&](const Exact& p, const Exact& q) {
        return p * share.below + (q - p) * share.above;
    };
    return {at(a.x, b.x), at(a.y, b.y), at(a.z, b.z), share.below};
}

/// Returns Positive iff a point, shifted by (e, e^2), lies to the left of a b in the map, and Zero only if a and b
/// coincide there.
Sign shifted_turn(const Point3& a, const Point3& b, const ExactPoint& p) {
    if (const Sign s = exact_sign(polynomial::orient2d(Axis::z, exact(a), exact(b), p));
        s != Sign::Zero)
        return s;
    return a.y != b.y ? sign_of(a.y - b.y) : sign_of(b.x - a.x);
}

/// The height of the plane of a triangle on the vertical line through a point, above it, and the derivatives by shifts
/// of the line along x and y: numerators over a common denominator.
struct HeightAbove {
    std::uint32_t triangle = 0;
    Sign side = Sign::Zero; ///< of the triangle, on which the point lies
    std::array<Exact, 3> above{};
    Exact below{}; ///< > 0

    /// Whether the shifted line meets this triangle before the other one.
    [[nodiscard]] bool is_before(const HeightAbove& other) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (const Sign s = exact_sign(above[i] * other.below - other.above[i] * below);
                s != Sign::Zero)
                return s == Sign::Negative;
        throw std::logic_error("two triangles overlap");
    }
};

/// Returns the height of a triangle that the shifted line through a point meets above it.
std::optional<HeightAbove> height_above(const ThreePoints& t, const ExactPoint& p) {
    const Sign turn = orient2d(Axis::z, t[0], t[1], t[2]);
    if (turn == Sign::Zero) return std::nullopt;
    for (std::size_t i = 0; i < 3; ++i)
        if (shifted_turn(t[i], t[(i + 1) % 3], p) != turn) return std::nullopt;
    const auto a = exact(t[0]);
    const auto n = cross(difference(exact(t[1]), a), difference(exact(t[2]), a));
    const Exact off = dot(n, difference(p, a));       // times the weight of p
    if (exact_sign(off) == turn) return std::nullopt; // the point is above the triangle
    HeightAbove made{0, exact_sign(off), {-off, -(n.x * p.w), -(n.y * p.w)}, n.z * p.w};
    if (turn == Sign::Positive) return made;
    made.below = -made.below;
    for (Exact& number : made.above) number = -number;
    return made;
}

/// Returns the doubles next to a quotient on both sides.
std::array<double, 2> around(const Exact& above, const Exact& below) {
    const double nearest = nearest_quotient(above, below);
    return {std::nextafter(nearest, -HUGE_VAL), std::nextafter(nearest, HUGE_VAL)};
}

} // namespace

double number_at(const Share& share, double a, double b) {
    return nearest_quotient(Exact(a) * share.below + (Exact(b) - Exact(a)) * share.above,
                            share.below);
}

SegmentSearch::SegmentSearch(const Mesh& mesh, const Volumes& volumes) :
    mesh_(mesh), volumes_(volumes), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    const auto middle = [&](std::uint32_t t) {
        const auto [p, q, r] = corners_of(mesh_, t);
        return std::array{p.x / 3 + q.x / 3 + r.x / 3, p.y / 3 + q.y / 3 + r.y / 3,
                          p.z / 3 + q.z / 3 + r.z / 3};
    };
    const auto node = [&](std::uint32_t first, std::uint32_t last) {
        Node made{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, first, last};
        for (std::uint32_t i = first; i < last; ++i)
            for (const Point3& p : corners_of(mesh_, order_[i])) {
                made.low = {std::min(made.low.x, p.x), std::min(made.low.y, p.y),
                            std::min(made.low.z, p.z)};
                made.high = {std::max(made.high.x, p.x), std::max(made.high.y, p.y),
                             std::max(made.high.z, p.z)};
            }
        return made;
    };
    build_median_tree(order_, nodes_, most_in_leaf, middle, node);
}

template <class Visit>
void SegmentSearch::for_near(const Point3& low, const Point3& high, const Visit& visit) const {
    std::vector<std::uint32_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
        const Node& node = nodes_[open.back()];
        open.pop_back();
        if (node.low.x > high.x || node.low.y > high.y || node.low.z > high.z ||
            node.high.x < low.x || node.high.y < low.y || node.high.z < low.z)
            continue;
        if (node.children > 0) {
            open.push_back(node.children);
            open.push_back(node.children + 1);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.last; ++i) visit(order_[i]);
    }
}

std::vector<SegmentContact> SegmentSearch::contacts(const PathSegment& segment) const {
    const auto& [a, b] = segment;
    std::vector<SegmentContact> found;
    for_near({std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
             {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}, [&](std::uint32_t t) {
                 auto contact = contact_of(segment, corners_of(mesh_, t));
                 if (!contact) return;
                 contact->triangle = t;
                 found.push_back(std::move(*contact));
             });
    return found;
}

std::uint32_t SegmentSearch::block_between(const PathSegment& segment, const Share& s,
                                           const Share& t) const {
    const ExactPoint p =
        point_at(segment, {s.above * t.below + t.above * s.below, Exact(2.0) * s.below * t.below});
    const auto x = around(p.x, p.w), y = around(p.y, p.w), z = around(p.z, p.w);
    std::optional<HeightAbove> lowest;
    for_near({x[0], y[0], z[0]}, {x[1], y[1], HUGE_VAL}, [&](std::uint32_t triangle) {
        auto height = height_above(corners_of(mesh_, triangle), p);
        if (!height) return;
        height->triangle = triangle;
        if (!lowest || height->is_before(*lowest)) lowest = std::move(height);
    });
    return lowest ? block(lowest->triangle, lowest->side) : 0;
}

} // namespace terrane::sections
