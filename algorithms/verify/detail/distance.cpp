// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/distance.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <terrane/algorithms/verify/detail/violations.hpp>
#include <terrane/algorithms/verify/stoppable.hpp>

namespace terrane::verifier {

Vector3 difference(const Vector4& a, const Vector4& b) {
    look_for_stop();
    return {mpz_class(a[0] - a[3] * b[0]), mpz_class(a[1] - a[3] * b[1]),
            mpz_class(a[2] - a[3] * b[2])};
}

Vector3 cross(const Vector3& a, const Vector3& b) {
    return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
            mpz_class(a[0] * b[1] - a[1] * b[0])};
}

mpz_class dot(const Vector3& a, const Vector3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 normal_of(const std::array<const Vector4*, 3>& triangle) {
    return cross(difference(*triangle[1], *triangle[0]), difference(*triangle[2], *triangle[0]));
}

Squared squared_distance(const Vector4& a, const Vector4& b) {
    look_for_stop();
    Squared result;
    for (std::size_t i = 0; i < 3; ++i) {
        const mpz_class d = a[i] * b[3] - b[i] * a[3];
        result.above += d * d;
    }
    const mpz_class denominator = a[3] * b[3];
    result.below = denominator * denominator;
    return result;
}

Squared squared_distance(const Vector4& point, const Vector4& start, const Vector4& end) {
    const Vector3 along = difference(end, start);
    const Vector3 from_start = difference(point, start); // times w, like all that follow
    const mpz_class place = dot(from_start, along);
    if (sgn(place) <= 0) return squared_distance(point, start);
    const mpz_class length = dot(along, along);
    if (place >= point[3] * length) return squared_distance(point, end);
    const Vector3 area = cross(from_start, along);
    return {dot(area, area), mpz_class(point[3] * point[3] * length)};
}

Squared squared_distance(const Vector4& point, const std::array<const Vector4*, 3>& triangle) {
    const Vector3 normal = normal_of(triangle);
    const mpz_class size = dot(normal, normal);
    std::optional<Squared> least; // to the sides beyond which the point projects along the normal
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector4& start = *triangle[i];
        const Vector4& end = *triangle[(i + 1) % 3];
        if (sgn(size) != 0 &&
            sgn(dot(normal, cross(difference(end, start), difference(point, start)))) >= 0)
            continue;
        Squared distance = squared_distance(point, start, end);
        if (!least || distance < *least) least = std::move(distance);
    }
    if (least) return *least;
    const mpz_class height = dot(normal, difference(point, *triangle[0]));
    return {mpz_class(height * height), mpz_class(point[3] * point[3] * size)};
}

bool within(const Squared& distance, const mpz_class& bound) {
    return distance.above <= bound * bound * distance.below;
}

Squared squared_height(const std::array<const Vector4*, 3>& triangle) {
    const Vector3 normal = normal_of(triangle);
    mpz_class longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3 side = difference(*triangle[(i + 1) % 3], *triangle[i]);
        if (mpz_class length = dot(side, side); length > longest) longest = std::move(length);
    }
    return {dot(normal, normal), std::move(longest)};
}

double root_above(const Squared& distance, const mpz_class& scale) {
    if (sgn(distance.above) == 0) return 0;
    const mpz_class below = distance.below * scale * scale;
    const auto bits = [](const mpz_class& n) {
        return static_cast<long>(mpz_sizeinbase(n.get_mpz_t(), 2));
    };
    // A root of 64 or 65 bits, times 2^-shift.
    const long shift = (130 - (bits(distance.above) - bits(below))) / 2;
    const auto power = static_cast<mp_bitcnt_t>(2 * std::abs(shift));
    const mpz_class above = shift > 0 ? mpz_class(distance.above << power) : distance.above;
    const mpz_class divisor = shift < 0 ? mpz_class(below << power) : below;
    mpz_class quotient, root, rest;
    mpz_cdiv_q(quotient.get_mpz_t(), above.get_mpz_t(), divisor.get_mpz_t());
    mpz_sqrtrem(root.get_mpz_t(), rest.get_mpz_t(), quotient.get_mpz_t());
    if (sgn(rest) != 0) root += 1;
    const double truncated = std::ldexp(root.get_d(), static_cast<int>(-shift));
    return std::nextafter(truncated, infinity);
}

bool within(const Vector4& a, const Vector4& b, const mpz_class& bound) {
    return within(squared_distance(a, b), bound);
}

bool within_of_segment(const Vector4& point, const Vector4& start, const Vector4& end,
                       const mpz_class& bound) {
    return within(squared_distance(point, start, end), bound);
}

bool within(const Vector4& point, const std::array<const Vector4*, 3>& triangle,
            const mpz_class& bound) {
    return within(squared_distance(point, triangle), bound);
}

// --- Segments near triangles --------------------------------------------------------------------

namespace {

/// A point of a segment: the fraction above / length of the way along it.
struct Stop {
    mpz_class above;
    std::uint32_t corner; ///< the point that projects there; none for the ends
};

} // namespace

/// A segment that is judged.
struct NearTriangles::Segment {
    const Vector4 &start, &end;
    Vector3 along = difference(end, start);
    mpz_class length = dot(along, along);

    /// Returns the point that divides the segment at the fraction above / (length * 2^halvings).
    [[nodiscard]] Vector4 point_at(const mpz_class& above, unsigned halvings) const {
        const mpz_class whole = length << halvings;
        Vector4 point;
        for (std::size_t i = 0; i < 3; ++i) point[i] = start[i] * whole + along[i] * above;
        point[3] = whole;
        return point;
    }
};

NearTriangles::NearTriangles(std::span<const Vector4> points, std::span<const Triangle> triangles,
                             const mpz_class& bound) :
    points_(points),
    triangles_(triangles), bound_(bound) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t corner : triangles[t]) at_corner_.push_back({corner, t});
    std::ranges::sort(at_corner_);
    all_.resize(triangles.size());
    std::iota(all_.begin(), all_.end(), 0U);
    if (triangles.size() <= few) return;
    const double by = enclose({bound, bound, bound, 1}, 1).high[0];
    std::vector<Box> boxes;
    for (const Triangle& t : triangles) boxes.push_back(widened_by(box_of(points, t), by));
    tree_ = BoxTree(std::move(boxes));
}

bool NearTriangles::is_near(const Vector4& point, std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return within(point, {&points_[a], &points_[b], &points_[c]}, bound_);
}

std::vector<std::uint32_t> NearTriangles::around(const Vector4& p, const Vector4& q) const {
    if (triangles_.size() <= few) return all_;
    Box box = enclose(p, 1);
    extend(box, enclose(q, 1));
    return tree_.touching(box);
}

bool NearTriangles::has_one(const Vector4& p, const Vector4& q) const {
    return std::ranges::any_of(around(p, p),
                               [&](std::uint32_t t) { return is_near(p, t) && is_near(q, t); });
}

bool NearTriangles::reach(const Vector4& start, const Vector4& end) const {
    const Segment segment{start, end};
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t t : around(start, end))
        corners.insert(corners.end(), triangles_[t].begin(), triangles_[t].end());
    make_set(corners);
    std::vector<Stop> stops{{0, no_number}, {segment.length, no_number}};
    for (const std::uint32_t corner : corners) {
        mpz_class place = dot(difference(points_[corner], start), segment.along);
        if (sgn(place) <= 0 || place >= segment.length) continue;
        if (!within_of_segment(points_[corner], start, end, bound_)) continue;
        stops.push_back({std::move(place), corner});
    }
    std::ranges::sort(stops, [](const Stop& a, const Stop& b) {
        if (const int order = cmp(a.above, b.above); order != 0) return order < 0;
        return a.corner < b.corner;
    });
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (stops[i - 1].above != stops[i].above &&
            !piece_is_near(segment, stops[i - 1].above, stops[i].above,
                           {stops[i - 1].corner, stops[i].corner}))
            return false;
    return true;
}

bool NearTriangles::piece_is_near(const Segment& segment, const mpz_class& from,
                                  const mpz_class& to, const Edge& corners) const {
    const Vector4 first = segment.point_at(from, 0), last = segment.point_at(to, 0);
    for (const std::uint32_t corner : corners) // mostly a triangle at one of the stops will do
        for (auto at = std::ranges::lower_bound(at_corner_, Edge{corner, 0});
             at != at_corner_.end() && (*at)[0] == corner; ++at)
            if (is_near(first, (*at)[1]) && is_near(last, (*at)[1])) return true;
    return has_one(first, last) || is_near_by_halves(segment, from, to, 0);
}

/// Tells whether a piece can be divided into parts each of which is near one triangle. Halving finds
/// the places where one triangle takes over from another: a half without such a place is near a
/// triangle that its middle is near, so that few halves are divided further.
bool NearTriangles::is_near_by_halves(const Segment& segment, const mpz_class& from,
                                      const mpz_class& to, unsigned halvings) const {
    constexpr unsigned most_halvings = 64; // bounds are doubles, with a slack of some spacings
    if (halvings == most_halvings) return false;
    const mpz_class first = 2 * from, middle = from + to, last = 2 * to;
    const Vector4 point = segment.point_at(middle, halvings + 1);
    auto near = around(point, point);
    std::erase_if(near, [&](std::uint32_t t) { return !is_near(point, t); });
    if (near.empty()) return false;
    const auto half_is_near = [&](const mpz_class& a, const mpz_class& b, const mpz_class& end) {
        const Vector4 other = segment.point_at(end, halvings + 1);
        return std::ranges::any_of(near, [&](std::uint32_t t) { return is_near(other, t); }) ||
               is_near_by_halves(segment, a, b, halvings + 1);
    };
    return half_is_near(first, middle, first) && half_is_near(middle, last, last);
}

} // namespace terrane::verifier
