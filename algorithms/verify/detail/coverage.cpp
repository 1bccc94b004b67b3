// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/coverage.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <terrane/algorithms/verify/detail/edges.hpp>

namespace terrane::verifier {

namespace {

constexpr std::size_t few = 32; ///< children; for fewer a tree takes longer
// How many children are looked at: at first, and for each child.
constexpr std::size_t first_looks = 100'000, looks_per_child = 64;

/// A fraction first / second with a positive denominator.
using Fraction = std::pair<mpz_class, mpz_class>;

bool is_before(const Fraction& a, const Fraction& b) {
    return a.first * b.second < b.first * a.second;
}

Vector4 weighted(const Vector4& a, const mpz_class& s, const Vector4& b, const mpz_class& t) {
    Vector4 sum;
    for (std::size_t i = 0; i < 4; ++i) sum[i] = s * a[i] + t * b[i];
    return sum;
}

} // namespace

Coverage::Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
                   const mpz_class& collar) :
    parent_(parent),
    points_(points), collar_(collar), normal_(normal_of(parent)),
    along_(difference(*parent[1], *parent[0])), across_(cross(normal_, along_)) {}

Coverage::Coverage(const std::array<const Vector4*, 3>& parent, std::span<const Vector4> points,
                   const mpz_class& collar, const CoveredRegion& region) :
    Coverage(parent, points, collar) {
    region_ = region;
    borders_.emplace(region.points, region.borders, collar);
}

/// Returns a box around a point in the projection, in units that differ along and across.
Box Coverage::box_of(const Vector4& point) const {
    return enclose({dot(along_, {point[0], point[1], point[2]}),
                    dot(across_, {point[0], point[1], point[2]}), 0, point[3]},
                   1);
}

Coverage::Facing::Facing(const Coverage& coverage, std::span<const Triangle> children) :
    coverage_(coverage) {
    for (Triangle t : children) {
        const auto& points = coverage.points_;
        const int sign = coverage.side_of(points[t[0]], points[t[1]], points[t[2]]);
        if (sign < 0) std::swap(t[1], t[2]);
        if (sign != 0) triangles.push_back(t);
    }
    std::vector<Box> boxes;
    for (const Triangle& t : triangles) {
        if (triangles.size() <= few) break;
        Box box = coverage.box_of(coverage.points_[t[0]]);
        for (const std::size_t i : {1U, 2U}) extend(box, coverage.box_of(coverage.points_[t[i]]));
        boxes.push_back(box);
    }
    tree_ = BoxTree(std::move(boxes));
    left_ = first_looks + looks_per_child * triangles.size();
}

const NearTriangles& Coverage::Facing::near() const {
    if (!near_) near_.emplace(coverage_.points_, triangles, coverage_.collar_);
    return *near_;
}

std::optional<std::vector<Triangle>> Coverage::Facing::around(const Vector4& p,
                                                              const Vector4& q) const {
    std::vector<Triangle> found;
    if (triangles.size() <= few) {
        found = triangles;
    } else {
        Box box = coverage_.box_of(p);
        extend(box, coverage_.box_of(q));
        for (const std::uint32_t t : tree_.touching(box)) found.push_back(triangles[t]);
    }
    if (found.size() > left_) return std::nullopt;
    left_ -= found.size();
    return found;
}

/// Returns 1 for a point on the left of the line, seen against the normal, -1 on its right, 0 on
/// it. `from` and `to` have w = 1.
int Coverage::side_of(const Vector4& from, const Vector4& to, const Vector4& point) const {
    return sgn(dot(normal_, cross(difference(to, from), difference(point, from))));
}

bool Coverage::near_border(const Vector4& a, const Vector4& b) const {
    if (borders_) return borders_->has_one(a, b);
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
    return borders_ && borders_->reach(a, b);
}

bool Coverage::covers_centroids(const Facing& children) const {
    if (!region_) return covers_centroid(parent_, children);
    return std::ranges::all_of(region_->triangles, [&](const Triangle& t) {
        const auto& points = region_->points;
        return covers_centroid({&points[t[0]], &points[t[1]], &points[t[2]]}, children);
    });
}

bool Coverage::covers_centroid(const std::array<const Vector4*, 3>& part,
                               const Facing& children) const {
    Vector4 centroid{0, 0, 0, 3};
    for (const Vector4* corner : part)
        for (std::size_t i = 0; i < 3; ++i) centroid[i] += (*corner)[i];
    for (std::size_t i = 0; i < 3; ++i)
        if (within_of_segment(centroid, *part[i], *part[(i + 1) % 3], collar_)) return true;
    const auto around = children.around(centroid, centroid);
    return around &&
           std::ranges::any_of(*around, [&](const Triangle& t) { return has_in(t, centroid); });
}

/// Tells whether children cover an edge when projected along the normal, and the places next to it
/// on a side, if that is not 0. Between the places where borders of children meet the edge, pieces
/// for which is_exempt(ends) is true need not be covered.
template <class IsExempt>
bool Coverage::is_covered(const Vector4& from, const Vector4& to, int side, const Facing& children,
                          const IsExempt& is_exempt) const {
    const Vector3 along = difference(to, from);
    const Vector3 left = cross(normal_, along);
    const Vector3 forward = cross(left, normal_); // the edge, projected along the normal
    const mpz_class length = dot(forward, along);
    std::vector<Fraction> places{{0, 1}, {length, 1}};
    std::vector<std::array<Fraction, 2>> stretches;
    const auto around = children.around(from, to);
    if (!around) return false;
    for (const Triangle& t : *around) {
        std::array<mpz_class, 3> heights, shares;
        bool is_beside = side == 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3 corner = difference(points_[t[i]], from);
            heights[i] = dot(left, corner);
            shares[i] = dot(forward, corner);
            is_beside = is_beside || sgn(heights[i]) == side;
        }
        std::vector<Fraction> met;
        for (std::size_t i = 0; i < 3; ++i) {
            const mpz_class &u = heights[i], &v = heights[(i + 1) % 3];
            if (sgn(u) == 0) met.emplace_back(shares[i], 1);
            if (sgn(u) * sgn(v) < 0)
                met.emplace_back(abs(v) * shares[i] + abs(u) * shares[(i + 1) % 3],
                                 abs(mpz_class(u - v)));
        }
        std::ranges::sort(met, is_before);
        for (const Fraction& place : met)
            if (sgn(place.first) > 0 && place.first < length * place.second)
                places.push_back(place);
        if (is_beside && met.size() > 1) stretches.push_back({met.front(), met.back()});
    }
    std::ranges::sort(places, is_before);
    std::ranges::sort(stretches,
                      [](const auto& a, const auto& b) { return is_before(a[0], b[0]); });
    Fraction end{0, 1}; // of what is covered from a place on
    auto next = stretches.begin();
    for (std::size_t i = 1; i < places.size(); ++i) {
        for (; next != stretches.end() && !is_before(places[i - 1], (*next)[0]); ++next)
            if (is_before(end, (*next)[1])) end = (*next)[1];
        if (!is_before(end, places[i]) || !is_before(places[i - 1], places[i])) continue;
        const auto point_at = [&](const Fraction& place) {
            return weighted(from, length * place.second - place.first, to, place.first);
        };
        if (!is_exempt(point_at(places[i - 1]), point_at(places[i]))) return false;
    }
    return true;
}

bool Coverage::reaches(const Vector4& from, const Vector4& to, const Facing& children) const {
    return is_covered(from, to, 0, children, [&](const Vector4& a, const Vector4& b) {
        return children.near().has_one(a, b);
    });
}

bool Coverage::holds(const Facing& children) const {
    if (!covers_centroids(children)) return false;
    bool covered = true;
    for_each_edge(half_edges(children.triangles), [&](std::span<const HalfEdge> sides) {
        const Edge& edge = sides[0].edge;
        const bool on_both_sides = std::ranges::any_of(
            sides, [&](const HalfEdge& side) { return side.ascends != sides[0].ascends; });
        if (!covered || on_both_sides || near_border(edge)) return;
        covered =
            is_covered(points_[edge[0]], points_[edge[1]], sides[0].ascends ? -1 : 1, children,
                       [&](const Vector4& a, const Vector4& b) { return near_border(a, b); });
    });
    return covered;
}

} // namespace terrane::verifier
