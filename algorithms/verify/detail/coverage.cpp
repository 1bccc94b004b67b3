// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/coverage.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace terrane::verifier {

namespace {

/// A fraction first / second with a positive denominator.
using Fraction = std::pair<mpz_class, mpz_class>;

int compare(const Fraction& a, const Fraction& b) {
    return cmp(a.first * b.second, b.first * a.second);
}

Vector4 weighted(const Vector4& a, const mpz_class& s, const Vector4& b, const mpz_class& t) {
    Vector4 sum;
    for (std::size_t i = 0; i < 4; ++i) sum[i] = s * a[i] + t * b[i];
    return sum;
}

/// Returns the middle between two points.
Vector4 middle(const Vector4& a, const Vector4& b) {
    return weighted(a, b[3], b, a[3]);
}

} // namespace

Coverage::Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
                   const mpz_class& collar) :
    parent_(parent),
    points_(points), collar_(collar),
    normal_(cross(difference(*parent[1], *parent[0]), difference(*parent[2], *parent[0]))) {}

Coverage::Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
                   const mpz_class& collar, const CoveredRegion& region) :
    Coverage(parent, points, collar) {
    region_ = region;
}

/// Returns 1 for a point on the left of the line, seen against the normal, -1 on its right, 0 on
/// it. `from` and `to` have w = 1.
int Coverage::side_of(const Vector4& from, const Vector4& to, const Vector4& point) const {
    return sgn(dot(normal_, cross(difference(to, from), difference(point, from))));
}

bool Coverage::near_border(const Vector4& a, const Vector4& b) const {
    if (region_)
        return std::ranges::any_of(region_->borders, [&](const Triangle& t) {
            const Vector4 &start = region_->points[t[0]], &end = region_->points[t[1]];
            return within_of_segment(a, start, end, collar_) &&
                   within_of_segment(b, start, end, collar_);
        });
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector4& start = *parent_[i];
        const Vector4& end = *parent_[(i + 1) % 3];
        if (within_of_segment(a, start, end, collar_) && within_of_segment(b, start, end, collar_))
            return true;
    }
    return false;
}

bool Coverage::has_in(const Triangle& child, const Vector4& point) const {
    for (std::size_t i = 0; i < 3; ++i)
        if (side_of(points_[child[i]], points_[child[(i + 1) % 3]], point) < 0) return false;
    return true;
}

/// Tells whether an edge is near the border. A region's border may have several edges near it.
bool Coverage::near_border(const Edge& edge) const {
    const Vector4 &a = points_[edge[0]], &b = points_[edge[1]];
    if (near_border(a, b)) return true;
    return region_ && segment_is_near({&a, &b}, region_->points, region_->borders, collar_);
}

bool Coverage::covers_centroids(std::span<const Triangle> children) const {
    if (!region_) return covers_centroid(parent_, children);
    return std::ranges::all_of(region_->triangles, [&](const Triangle& t) {
        const auto& points = region_->points;
        return covers_centroid({&points[t[0]], &points[t[1]], &points[t[2]]}, children);
    });
}

bool Coverage::covers_centroid(const std::array<const Vector4*, 3>& part,
                               std::span<const Triangle> children) const {
    Vector4 centroid{0, 0, 0, 3};
    for (const Vector4* corner : part)
        for (std::size_t i = 0; i < 3; ++i) centroid[i] += (*corner)[i];
    for (std::size_t i = 0; i < 3; ++i)
        if (within_of_segment(centroid, *part[i], *part[(i + 1) % 3], collar_)) return true;
    return std::ranges::any_of(children, [&](const Triangle& t) { return has_in(t, centroid); });
}

/// Returns the children that have area when projected along the normal, made counterclockwise.
std::vector<Triangle> Coverage::facing(std::span<const Triangle> children) const {
    std::vector<Triangle> result;
    for (Triangle t : children) {
        const int sign = side_of(points_[t[0]], points_[t[1]], points_[t[2]]);
        if (sign < 0) std::swap(t[1], t[2]);
        if (sign != 0) result.push_back(t);
    }
    return result;
}

/// Returns the points where borders of children meet an edge when projected along the normal:
/// points of the edge, in order, each once, including its ends.
std::vector<Vector4> Coverage::crossings(const Vector4& from, const Vector4& to,
                                         std::span<const Triangle> children) const {
    const Vector3 along = difference(to, from);
    const Vector3 left = cross(normal_, along);
    const Vector3 forward = cross(left, normal_); // the edge, projected along the normal
    const mpz_class length = dot(forward, along);
    std::vector<Fraction> places{{0, 1}, {length, 1}};
    const auto add = [&](const mpz_class& above, const mpz_class& below) {
        if (sgn(above) > 0 && above < length * below) places.emplace_back(above, below);
    };
    for (const Triangle& t : children)
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3 a = difference(points_[t[i]], from);
            const Vector3 b = difference(points_[t[(i + 1) % 3]], from);
            const mpz_class u = dot(left, a), v = dot(left, b);
            if (sgn(u) == 0) add(dot(forward, a), 1);
            if (sgn(u) * sgn(v) >= 0) continue;
            const mpz_class below = abs(mpz_class(u - v));
            add(abs(v) * dot(forward, a) + abs(u) * dot(forward, b), below);
        }
    std::ranges::sort(places, [](const auto& p, const auto& q) { return compare(p, q) < 0; });
    const auto same = [](const auto& p, const auto& q) { return compare(p, q) == 0; };
    places.erase(std::unique(places.begin(), places.end(), same), places.end());
    std::vector<Vector4> points;
    for (const auto& [above, below] : places) {
        const mpz_class rest = length * below - above;
        points.push_back(weighted(from, rest, to, above));
    }
    return points;
}

/// Tells whether a child covers the neighbourhood of a point on the other side of an edge. The
/// point is no corner of the child.
bool Coverage::covers_beside(const Triangle& child, const Side& side, const Vector4& point) const {
    const Vector4& from = points_[side.edge[0]];
    const Vector4& to = points_[side.edge[1]];
    for (std::size_t i = 0; i < 3; ++i) {
        const int place = side_of(points_[child[i]], points_[child[(i + 1) % 3]], point);
        if (place < 0) return false;
        if (place == 0 && side_of(from, to, points_[child[(i + 2) % 3]]) != -side.sign)
            return false;
    }
    return true;
}

/// Tells whether other children cover the other side of an edge that has children on one side only,
/// except near the border of the parent.
bool Coverage::covered_elsewhere(const Side& side, std::span<const Triangle> children) const {
    const auto places = crossings(points_[side.edge[0]], points_[side.edge[1]], children);
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (near_border(places[i - 1], places[i])) continue;
        const Vector4 point = middle(places[i - 1], places[i]);
        if (std::ranges::none_of(
                children, [&](const Triangle& child) { return covers_beside(child, side, point); }))
            return false;
    }
    return true;
}

bool Coverage::reaches(const Vector4& from, const Vector4& to,
                       std::span<const Triangle> all) const {
    const std::vector<Triangle> children = facing(all);
    const auto places = crossings(from, to, children);
    for (std::size_t i = 1; i < places.size(); ++i) {
        const Vector4 point = middle(places[i - 1], places[i]);
        const bool is_reached = std::ranges::any_of(children, [&](const Triangle& t) {
            const std::array<const Vector4*, 3> at{&points_[t[0]], &points_[t[1]], &points_[t[2]]};
            return has_in(t, point) ||
                   (within(places[i - 1], at, collar_) && within(places[i], at, collar_));
        });
        if (!is_reached) return false;
    }
    return true;
}

bool Coverage::holds(std::span<const Triangle> all) const {
    const std::vector<Triangle> children = facing(all);
    if (!covers_centroids(children)) return false;
    std::vector<Side> sides;
    for (const Triangle& t : children)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
            sides.push_back({{low, high}, low == t[i] ? 1 : -1});
        }
    std::ranges::sort(sides, [](const Side& a, const Side& b) {
        return std::pair(a.edge, a.sign) < std::pair(b.edge, b.sign);
    });
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
        const Side& side = sides[first];
        if (side.sign != sides[last - 1].sign) continue; // children on both sides
        if (near_border(side.edge)) continue;
        if (!covered_elsewhere(side, children)) return false;
    }
    return true;
}

} // namespace terrane::verifier
