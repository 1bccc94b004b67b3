// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/nearness.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <terrane/algorithms/verify/detail/distance.hpp>
#include <terrane/algorithms/verify/detail/measure.hpp>

namespace terrane::verifier {

namespace {

// --- Distances in double precision, which only propose -------------------------------------------

double product(const Point3& a, const Point3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

double to_segment(const Point3& p, const Point3& a, const Point3& b) {
    const Point3 along = vector_to(b, a), from = vector_to(p, a);
    const double length = product(along, along);
    const double share = length > 0 ? std::clamp(product(from, along) / length, 0.0, 1.0) : 0.0;
    const Point3 rest{from.x - share * along.x, from.y - share * along.y, from.z - share * along.z};
    return std::sqrt(product(rest, rest));
}

double to_triangle(const Point3& p, const std::array<Point3, 3>& t) {
    const Point3 normal = cross_product(vector_to(t[1], t[0]), vector_to(t[2], t[0]));
    const double size = product(normal, normal);
    bool inside = size > 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 &a = t[i], &b = t[(i + 1) % 3];
        if (inside && product(normal, cross_product(vector_to(b, a), vector_to(p, a))) >= 0)
            continue;
        inside = false;
        least = std::min(least, to_segment(p, a, b));
    }
    if (inside) return std::fabs(product(normal, vector_to(p, t[0]))) / std::sqrt(size);
    for (std::size_t i = 0; i < 3; ++i)
        least = std::min(least, to_segment(p, t[i], t[(i + 1) % 3]));
    return least;
}

// --- Exact points -------------------------------------------------------------------------------

/// Returns the middle of two points whose w are powers of two.
Vector4 middle(const Vector4& a, const Vector4& b) {
    if (a[3] < b[3]) return middle(b, a);
    const mpz_class factor = a[3] / b[3];
    Vector4 result;
    for (std::size_t i = 0; i < 3; ++i) result[i] = a[i] + b[i] * factor;
    result[3] = 2 * a[3];
    return result;
}

Point3 middle(const Point3& a, const Point3& b) {
    return {a.x / 2 + b.x / 2, a.y / 2 + b.y / 2, a.z / 2 + b.z / 2};
}

/// Returns the number of the longest side, from corner i to the next.
std::size_t longest_side(const std::array<Point3, 3>& t) {
    std::array<double, 3> length{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 side = vector_to(t[(i + 1) % 3], t[i]);
        length[i] = product(side, side);
    }
    return static_cast<std::size_t>(std::ranges::max_element(length) - length.begin());
}

} // namespace

double rounding_of(std::span<const Point3> points) {
    double largest = 0;
    for (const Point3& p : points)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    return largest * 0x1p-46;
}

Nearness::Nearness(const PointPairs& points, std::vector<Triangle> targets) :
    points_(points), targets_(std::move(targets)),
    pieces_(first_pieces + pieces_per_triangle * targets_.size()) {
    for (const Triangle& t : targets_) boxes_.push_back(box_of(points_.doubles, t));
    tree_ = BoxTree(boxes_);
}

std::array<Point3, 3> Nearness::corners(std::uint32_t target) const {
    const Triangle& t = targets_[target];
    return {points_.doubles[t[0]], points_.doubles[t[1]], points_.doubles[t[2]]};
}

/// Returns the targets, of some, that may be within reach of a piece.
std::vector<std::uint32_t> Nearness::within_reach(const Piece& piece,
                                                  std::span<const std::uint32_t> targets,
                                                  double reach) const {
    const Box box = widened_by(
        box_of(std::array{piece[0].near, piece[1].near, piece[2].near}, {0, 1, 2}), reach);
    std::vector<std::uint32_t> result;
    for (const std::uint32_t target : targets)
        if (touch(boxes_[target], box)) result.push_back(target);
    return result;
}

bool Nearness::is_near(const Piece& piece, std::uint32_t target, const Bound& bound) const {
    const Triangle& t = targets_[target];
    const std::array<const Vector4*, 3> at{&points_.exact[t[0]], &points_.exact[t[1]],
                                           &points_.exact[t[2]]};
    return std::ranges::all_of(
        piece, [&](const Corner& corner) { return within(corner.exact, at, bound.exact); });
}

bool Nearness::is_near_one(const Piece& piece, std::span<const std::uint32_t> targets,
                           const Bound& bound) const {
    double least = std::numeric_limits<double>::infinity();
    std::uint32_t best = 0;
    for (const std::uint32_t target : targets) {
        const auto at = corners(target);
        double farthest = 0;
        for (const Corner& corner : piece)
            if (farthest < least) farthest = std::max(farthest, to_triangle(corner.near, at));
        if (farthest < least) {
            least = farthest;
            best = target;
        }
    }
    return !targets.empty() && least <= reach(bound) && is_near(piece, best, bound);
}

bool Nearness::is_refuted(const Piece& piece, std::span<const std::uint32_t> targets,
                          const Bound& bound) const {
    return std::ranges::any_of(piece, [&](const Corner& corner) {
        return std::ranges::all_of(targets, [&](std::uint32_t target) {
            return to_triangle(corner.near, corners(target)) > reach(bound);
        });
    });
}

bool Nearness::covers(const Triangle& triangle, const Bound& bound) const {
    Piece whole;
    for (std::size_t i = 0; i < 3; ++i)
        whole[i] = {points_.doubles[triangle[i]], points_.exact[triangle[i]]};
    const auto all = tree_.touching(widened_by(box_of(points_.doubles, triangle), reach(bound)));
    std::vector<std::pair<Piece, std::vector<std::uint32_t>>> open{{whole, all}};
    for (pieces_ += pieces_per_triangle; !open.empty(); --pieces_) {
        const auto [piece, around] = std::move(open.back());
        open.pop_back();
        const auto targets = within_reach(piece, around, reach(bound));
        if (is_near_one(piece, targets, bound)) continue;
        if (is_refuted(piece, targets, bound)) return false;
        if (targets.empty() || pieces_ < 2 * open.size() + 1 || open.size() > 60) return false;
        const std::size_t i = longest_side({piece[0].near, piece[1].near, piece[2].near});
        const Corner &from = piece[i], &to = piece[(i + 1) % 3];
        const Corner half{middle(from.near, to.near), middle(from.exact, to.exact)};
        for (const std::size_t end : {i, (i + 1) % 3}) {
            open.push_back({piece, targets});
            open.back().first[end] = half;
        }
    }
    return true;
}

} // namespace terrane::verifier
