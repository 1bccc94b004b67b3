// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/plan_view.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace terrane::verifier {

namespace {

constexpr std::size_t up = 2; ///< the axis along which triangles are seen

// Most signs are clear from doubles. Rationals, whose common factors take the time, decide the rest.

/// Returns a double that is off by less than 2^-52 of the number. None: the number is so large or
/// so small that products of a few such doubles could overflow or underflow.
template <class Number>
std::optional<double> near(const Number& number) {
    const double rounded = number.get_d(); // truncated
    if (sgn(number) == 0) return 0.0;
    const double size = std::fabs(rounded);
    return size > 0x1p-200 && size < 0x1p200 ? std::optional(rounded) : std::nullopt;
}

struct NearPlace {
    std::optional<double> x, y;
};

NearPlace near_place(const Place& p) {
    return {near(p.x), near(p.y)};
}

NearPlace near_place(const Vector4& point) {
    return {near(point[0]), near(point[1])};
}

/// The sign of a double that is off by less than `error`; none if that could change it.
std::optional<int> clear_sign(double value, double error) {
    if (std::fabs(value) <= error) return std::nullopt;
    return value > 0 ? 1 : -1;
}

/// Returns the sign of turn(a, b, c) if it is clear. The factors of its two products are off by at
/// most 3 u X and 3 u Y, where u = 2^-52 and X and Y are the largest |x| and |y|; so the products,
/// at most 4 X Y, by 14 u X Y with their own rounding, and their difference by 32 u X Y.
std::optional<int> clear_turn(const NearPlace& a, const NearPlace& b, const NearPlace& c) {
    if (!a.x || !a.y || !b.x || !b.y || !c.x || !c.y) return std::nullopt;
    const double x = std::max({std::fabs(*a.x), std::fabs(*b.x), std::fabs(*c.x)}),
                 y = std::max({std::fabs(*a.y), std::fabs(*b.y), std::fabs(*c.y)});
    return clear_sign((*b.x - *a.x) * (*c.y - *a.y) - (*b.y - *a.y) * (*c.x - *a.x),
                      0x1p-46 * x * y);
}

int sign_of_turn(const Place& a, const Place& b, const Place& c) {
    const auto sign = clear_turn(near_place(a), near_place(b), near_place(c));
    return sign ? *sign : sgn(turn(a, b, c));
}

/// Returns the part of a polygon on the left of a line.
PlacePolygon left_part(const PlacePolygon& polygon, const Place& a, const Place& b) {
    std::vector<int> signs;
    for (const Place& p : polygon) signs.push_back(sign_of_turn(a, b, p));
    PlacePolygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const std::size_t next = (k + 1) % polygon.size();
        const Place &p = polygon[k], &q = polygon[next];
        if (signs[k] >= 0) kept.push_back(p);
        if (signs[k] * signs[next] >= 0) continue;
        const mpq_class u = turn(a, b, p), v = turn(a, b, q), share = u / (u - v);
        kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

/// Tells whether a segment passes through the interior of a polygon.
bool passes_through(const SegmentInPlan& s, const PlacePolygon& polygon) {
    mpq_class from = 0, to = 1;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Place &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const int first = sign_of_turn(p, q, s[0]), second = sign_of_turn(p, q, s[1]);
        if (first > 0 && second > 0) continue;
        if (first < 0 && second < 0) return false;
        const mpq_class u = turn(p, q, s[0]), v = turn(p, q, s[1]);
        if (u == v) {
            if (sgn(u) <= 0) return false;
            continue;
        }
        const mpq_class place = u / (u - v);
        if (u < v)
            from = std::max(from, place);
        else
            to = std::min(to, place);
        if (from >= to) return false;
    }
    return true;
}

/// Tells whether a line along an edge of s has all of t on its right.
bool separates(const UpwardCorners& s, const UpwardCorners& t) {
    const auto near_corners = [](const UpwardCorners& c) {
        return std::array{near_place(*c[0]), near_place(*c[1]), near_place(*c[2])};
    };
    const auto near_s = near_corners(s), near_t = near_corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        bool all_right = true;
        for (std::size_t k = 0; k < 3 && all_right; ++k) {
            const auto sign = clear_turn(near_s[i], near_s[j], near_t[k]);
            all_right = (sign ? *sign : sgn(turn(*s[i], *s[j], *t[k], up))) <= 0;
        }
        if (all_right) return true;
    }
    return false;
}

} // namespace

Place place_of(const Vector4& point) {
    return {point[0], point[1]};
}

mpq_class turn(const Place& a, const Place& b, const Place& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::optional<UpwardCorners> upward(UpwardCorners corners, bool& flipped) {
    const int side = sgn(turn(*corners[0], *corners[1], *corners[2], up));
    flipped = side < 0;
    if (flipped) std::swap(corners[1], corners[2]);
    return side == 0 ? std::nullopt : std::optional(corners);
}

bool are_beside(const UpwardCorners& s, const UpwardCorners& t) {
    return separates(s, t) || separates(t, s);
}

PlacePolygon common_part(const UpwardCorners& s, const UpwardCorners& t) {
    PlacePolygon polygon{place_of(*s[0]), place_of(*s[1]), place_of(*s[2])};
    for (std::size_t i = 0; i < 3; ++i)
        polygon = left_part(polygon, place_of(*t[i]), place_of(*t[(i + 1) % 3]));
    return polygon;
}

mpq_class height_over(const UpwardCorners& t, const Place& p) {
    const Place a = place_of(*t[0]), b = place_of(*t[1]), c = place_of(*t[2]);
    return (turn(b, c, p) * (*t[0])[2] + turn(c, a, p) * (*t[1])[2] + turn(a, b, p) * (*t[2])[2]) /
           turn(a, b, c);
}

Vector4 point_over(const UpwardCorners& t, const Place& p) {
    const std::array<mpq_class, 3> at{p.x, p.y, height_over(t, p)};
    mpz_class below = 1;
    for (const mpq_class& c : at) below = lcm(below, c.get_den());
    return {mpz_class(at[0].get_num() * (below / at[0].get_den())),
            mpz_class(at[1].get_num() * (below / at[1].get_den())),
            mpz_class(at[2].get_num() * (below / at[2].get_den())), below};
}

bool contains(const UpwardCorners& t, const Place& p) {
    for (std::size_t i = 0; i < 3; ++i)
        if (sign_of_turn(place_of(*t[i]), place_of(*t[(i + 1) % 3]), p) < 0) return false;
    return true;
}

Place mean_of(const PlacePolygon& polygon) {
    Place mean{0, 0};
    for (const Place& p : polygon) {
        mean.x += p.x;
        mean.y += p.y;
    }
    const mpq_class count(static_cast<unsigned long>(polygon.size()));
    return {mean.x / count, mean.y / count};
}

bool is_within(const Place& p, const SegmentInPlan& segment, const mpz_class& width) {
    const auto& [a, b] = segment;
    const mpq_class dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    mpq_class share = 0;
    if (sgn(length) > 0) share = ((p.x - a.x) * dx + (p.y - a.y) * dy) / length;
    if (share < 0) share = 0;
    if (share > 1) share = 1;
    const mpq_class u = p.x - a.x - share * dx, v = p.y - a.y - share * dy;
    return u * u + v * v <= width * width;
}

std::vector<PlacePolygon> divided_by(PlacePolygon polygon,
                                     std::span<const SegmentInPlan> segments) {
    std::vector<PlacePolygon> parts{std::move(polygon)};
    for (const SegmentInPlan& s : segments)
        for (std::size_t i = parts.size(); i-- > 0;) {
            if (!passes_through(s, parts[i])) continue;
            auto right = left_part(parts[i], s[1], s[0]);
            parts[i] = left_part(parts[i], s[0], s[1]);
            parts.push_back(std::move(right));
        }
    return parts;
}

} // namespace terrane::verifier
