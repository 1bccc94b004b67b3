// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/cells/base_below.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/polynomials.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane::cells {
namespace {

using MapVector = polynomial::Vector2<Exact>;

MapVector in_map(const Point3& from, const Point3& to) {
    return {Exact(to.x) - Exact(from.x), Exact(to.y) - Exact(from.y)};
}

/// Returns on which side of a b the point p is, moved towards the middle of p, q, r, and less towards q.
Sign moved_side(const Point3& a, const Point3& b, const std::array<const Point3*, 3>& pqr) {
    const auto& [p, q, r] = pqr;
    if (const Sign side = orient2d(Axis::z, a, b, *p); side != Sign::Zero) return side;
    const MapVector along = in_map(a, b), to_q = in_map(*p, *q), to_r = in_map(*p, *r);
    const Sign first = exact_sign(cross(along, to_q) + cross(along, to_r));
    return first != Sign::Zero ? first : exact_sign(cross(along, to_q));
}

std::size_t slot(double x, double low, double high, std::size_t count) {
    const double share = (x - low) / (high - low) * double(count); // NaN if all is in one line
    return share > 0 ? std::min(count - 1, static_cast<std::size_t>(std::min(share, double(count))))
                     : 0;
}

} // namespace

Status check_folds(const Surface& surface, const Run& run) {
    Surface map{surface.name, surface.role, surface.vertices, {}};
    for (Point3& p : map.vertices) p.z = 0;
    for (const Triangle& t : surface.triangles)
        if (orient2d(Axis::z, map.vertices[t[0]], map.vertices[t[1]], map.vertices[t[2]]) !=
            Sign::Zero)
            map.triangles.push_back(t);
    if (map.triangles.empty())
        return Error{ErrorCode::bad_option, "the surface is vertical", surface.name};
    const auto arranged = arrange(std::span(&map, 1), {}, run);
    if (!arranged) return arranged.error();
    for (std::size_t t = 0; t < arranged->triangles.size(); ++t)
        if (arranged->parents_of[t].size() > 1) {
            const Point3& p = arranged->nearest(VertexId(arranged->triangles[t][0]));
            return Error{ErrorCode::bad_option,
                         "the surface folds over: verticals near x = " + std::to_string(p.x) +
                             ", y = " + std::to_string(p.y) + " meet it more than once",
                         surface.name};
        }
    return Done{};
}

BaseBelow::BaseBelow(const Surface& surface) {
    low_ = {HUGE_VAL, HUGE_VAL, 0};
    high_ = {-HUGE_VAL, -HUGE_VAL, 0};
    for (const auto& [i, j, k] : surface.triangles) {
        std::array<Point3, 3> t{surface.vertices[i], surface.vertices[j], surface.vertices[k]};
        const Sign turn = orient2d(Axis::z, t[0], t[1], t[2]);
        if (turn == Sign::Zero) continue;
        if (turn == Sign::Negative) std::swap(t[1], t[2]);
        triangles_.push_back(t);
        for (const Point3& p : t) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), 0};
            high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), 0};
        }
    }
    side_ = 1 + static_cast<std::size_t>(std::sqrt(double(triangles_.size())));
    squares_.resize(side_ * side_);
    for (std::uint32_t n = 0; n < triangles_.size(); ++n) {
        const auto& [a, b, c] = triangles_[n];
        const auto [left, right] = std::minmax({a.x, b.x, c.x});
        const auto [front, back] = std::minmax({a.y, b.y, c.y});
        const auto from = square(left, front), to = square(right, back);
        for (std::size_t j = from[1]; j <= to[1]; ++j)
            for (std::size_t i = from[0]; i <= to[0]; ++i) squares_[j * side_ + i].push_back(n);
    }
}

std::array<std::size_t, 2> BaseBelow::square(double x, double y) const {
    return {slot(x, low_.x, high_.x, side_),
            slot(y, low_.y, high_.y, side_)}; // monotone in x and y
}

std::optional<std::array<Point3, 3>> BaseBelow::at(const Point3& p, const Point3& q,
                                                   const Point3& r) const {
    const auto [i, j] = square(p.x, p.y);
    for (const std::uint32_t n : squares_[j * side_ + i]) {
        const auto& [a, b, c] = triangles_[n];
        const std::array<const Point3*, 3> pqr{&p, &q, &r};
        const auto is_left = [&](const Point3& from, const Point3& to) {
            return moved_side(from, to, pqr) == Sign::Positive;
        };
        if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return triangles_[n];
    }
    return std::nullopt;
}

double height_on(const std::array<Point3, 3>& triangle, const Point3& p) {
    const auto& [a, b, c] = triangle;
    for (const Point3& corner : triangle)
        if (corner.x == p.x && corner.y == p.y) return corner.z;
    if (a.z == b.z && b.z == c.z) return a.z;
    const MapVector to_b = in_map(a, b), to_c = in_map(a, c), to_p = in_map(a, p);
    const Exact area = cross(to_b, to_c);
    const Exact rise = cross(to_p, to_c) * (Exact(b.z) - Exact(a.z)) +
                       cross(to_b, to_p) * (Exact(c.z) - Exact(a.z));
    return nearest_quotient(Exact(a.z) * area + rise, area);
}

} // namespace terrane::cells
