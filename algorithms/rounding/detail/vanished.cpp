// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/rounding/detail/vanished.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/disjoint_sets.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/mesh/triangle_tree.hpp>
#include <terrane/kernel/point_store.hpp>

namespace terrane::rounding::detail {
namespace {

using ExactVector = polynomial::Vector<Exact>;
using ExactCorner = polynomial::Coordinates<Exact, polynomial::One>;

/// Tells whether a length is at most `bound`, both times the same number: `square` is the square of
/// the length, `times` that of the number.
bool is_at_most(const Exact& square, const Exact& bound, const Exact& times) {
    return square <= bound * bound * times;
}

bool is_within_side(const ExactPoint& p, const ExactCorner& from, const ExactCorner& to,
                    const Exact& bound) {
    const ExactVector along = difference(to, from), away = difference(p, from); // away: times w
    const Exact place = dot(away, along), length = dot(along, along);
    if (exact_sign(place) != Sign::Positive) return is_at_most(dot(away, away), bound, p.w * p.w);
    if (place >= length * p.w) {
        const ExactVector beyond = difference(p, to);
        return is_at_most(dot(beyond, beyond), bound, p.w * p.w);
    }
    const ExactVector area = cross(away, along);
    return is_at_most(dot(area, area), bound, p.w * p.w * length);
}

/// Tells whether a point is at most `bound` from a triangle with area.
bool is_within(const ExactPoint& p, const std::array<ExactCorner, 3>& t, const Exact& bound) {
    const ExactVector normal = cross(difference(t[1], t[0]), difference(t[2], t[0]));
    bool is_above = true; // whether the point projects into the triangle along the normal
    for (unsigned i = 0; i < 3; ++i) {
        const ExactVector side = difference(t[(i + 1) % 3], t[i]);
        is_above =
            is_above && exact_sign(dot(normal, cross(side, difference(p, t[i])))) != Sign::Negative;
    }
    if (!is_above) {
        for (unsigned i = 0; i < 3; ++i)
            if (is_within_side(p, t[i], t[(i + 1) % 3], bound)) return true;
        return false;
    }
    const Exact height = dot(normal, difference(p, t[0]));
    return is_at_most(height * height, bound, p.w * p.w * dot(normal, normal));
}

/// A segment, whose ends have one weight, and its ends as doubles.
struct Piece {
    std::array<ExactPoint, 2> ends;
    std::array<Point3, 2> near;
};

Point3 middle(const Point3& a, const Point3& b) {
    return {a.x / 2 + b.x / 2, a.y / 2 + b.y / 2, a.z / 2 + b.z / 2};
}

ExactPoint middle(const ExactPoint& a, const ExactPoint& b) {
    const Exact half(0.5);
    return {(a.x + b.x) * half, (a.y + b.y) * half, (a.z + b.z) * half, a.w};
}

Piece piece_between(const PointStore& points, PointIndex a, PointIndex b) {
    const ExactPoint p = points.exact(a), q = points.exact(b);
    return {{ExactPoint{p.x * q.w, p.y * q.w, p.z * q.w, p.w * q.w},
             ExactPoint{q.x * p.w, q.y * p.w, q.z * p.w, p.w * q.w}},
            {points.nearest(a), points.nearest(b)}};
}

/// The remains of all input triangles.
class Remains {
public:
    explicit Remains(const Mesh& mesh) :
        points_(mesh.vertices), tree_(mesh.vertices, mesh.triangles) {
        for (const Point3& p : points_)
            noise_ = std::max({noise_, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        noise_ = std::max(noise_ * 0x1p-46, std::numeric_limits<double>::min());
    }

    /// Tells whether each point of a piece is shown to be at most `bound` from the mesh. The distance
    /// from one triangle is convex, so a piece is near it if both ends are; others are halved.
    /// Doubles choose the triangles.
    [[nodiscard]] bool are_near(const Piece& piece, double bound, unsigned halvings = 0) const {
        const Point3 half = middle(piece.near[0], piece.near[1]);
        const double least = tree_.distance(half, HUGE_VAL);
        if (least > bound + noise_ || halvings > most_halvings) return false;
        for (const auto& found : tree_.within(half, least + noise_))
            if (is_near(piece, found.triangle, Exact(bound))) return true;
        const ExactPoint exact_half = middle(piece.ends[0], piece.ends[1]);
        return are_near({{piece.ends[0], exact_half}, {piece.near[0], half}}, bound,
                        halvings + 1) &&
               are_near({{exact_half, piece.ends[1]}, {half, piece.near[1]}}, bound, halvings + 1);
    }

    /// Returns how far some points of a piece are from the mesh, in floating point.
    [[nodiscard]] double sample(const Piece& piece) const {
        double farthest = 0;
        for (const Point3& p : {piece.near[0], middle(piece.near[0], piece.near[1]), piece.near[1]})
            farthest = std::max(farthest, tree_.distance(p, HUGE_VAL));
        return farthest;
    }

    [[nodiscard]] double noise() const { return noise_; }

private:
    static constexpr unsigned most_halvings = 60;

    [[nodiscard]] bool is_near(const Piece& piece, const Triangle& t, const Exact& bound) const {
        const auto at = [&](unsigned i) { return polynomial::cartesian<Exact>(points_[t[i]]); };
        const std::array<ExactCorner, 3> corners{at(0), at(1), at(2)};
        return is_within(piece.ends[0], corners, bound) && is_within(piece.ends[1], corners, bound);
    }

    std::span<const Point3> points_;
    TriangleTree tree_;
    double noise_ = 0; ///< more than the error of a distance in floating point, and not 0
};

/// Returns the sides of input triangles in `gone`, or of their parts if others were removed.
std::vector<Piece> sides_of(const Arrangement& a, std::span<const std::uint32_t> gone) {
    std::vector<Piece> sides;
    const auto add = [&](PointIndex u, PointIndex v, PointIndex w) {
        for (const auto& [from, to] : {std::pair(u, v), std::pair(v, w), std::pair(w, u)})
            sides.push_back(piece_between(a.state->points, from, to));
    };
    if (a.state->whole)
        for (const std::uint32_t t : gone) {
            const auto& [u, v, w] = a.state->corners[t];
            add(u, v, w);
        }
    for (std::size_t t = 0; !a.state->whole && t < a.triangles.size(); ++t)
        if (std::ranges::any_of(a.parents_of[t], [&](std::uint32_t parent) {
                return std::ranges::binary_search(gone, parent);
            })) {
            const auto& [u, v, w] = a.triangles[t];
            add(a.vertices[u], a.vertices[v], a.vertices[w]);
        }
    return sides;
}

} // namespace

std::vector<std::uint32_t> vanished(const Arrangement& a,
                                    const IndexLists<std::uint32_t>& parents_of) {
    std::vector<bool> present(a.inputs.first.back(), false);
    for (const std::uint32_t p : parents_of.values) present[p] = true;
    std::vector<std::uint32_t> result;
    for (const std::uint32_t p : a.parents_of.values)
        if (!present[p]) result.push_back(p);
    sort_unique(result);
    return result;
}

Error nothing_left() {
    return {ErrorCode::nothing_to_do,
            "rounding would take the area of all triangles, so that nothing would be left; allow "
            "surfaces to move less, or put them nearer to the origin",
            ""};
}

void state_vanished_length(const Arrangement& a, RoundedMesh& rounded, const Run& run) {
    RoundingReport& report = rounded.report;
    const Remains remains(*rounded.mesh);
    const std::vector<Piece> sides = sides_of(a, report.vanished);
    constexpr double room = 1 - 0x1p-8; // another method has to show the bound, too
    const double known = report.surface_deviation + report.vanished_length;
    const auto far = concatenated(parts_of_ranges<std::vector<std::size_t>>(
        sides.size(), run, [&](std::size_t first, std::size_t last) {
            std::vector<std::size_t> part;
            for (std::size_t k = first; k < last; ++k)
                if (!remains.are_near(sides[k], known * room)) part.push_back(k);
            return part;
        }));
    if (far.empty()) return;
    double bound = known;
    constexpr double largest = std::numeric_limits<double>::max() / 16;
    for (const std::size_t k : far)
        while (bound < largest && !remains.are_near(sides[k], bound * room))
            bound = std::max({2 * bound, remains.sample(sides[k]) * (1 + 0x1p-3), remains.noise()});
    report.vanished_length = bound;
    report.deviation = (report.surface_deviation + bound) * (1 + 0x1p-51);
}

} // namespace terrane::rounding::detail
