// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/maps/verticals.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/numbers.hpp>
#include <terrane/kernel/polynomials.hpp>

namespace terrane {
namespace {

Sign sign_of(double x) {
    return x > 0 ? Sign::Positive : x < 0 ? Sign::Negative : Sign::Zero;
}

Sign times(Sign sign, int shift) {
    return shift > 0 ? sign : -sign;
}

/// Returns on which side of the line from a to b, which differ in the map, a point on the line moves.
Sign side_of_shift(const Point3& a, const Point3& b, const VerticalShift& shift) {
    return a.y != b.y ? times(a.y > b.y ? Sign::Positive : Sign::Negative, shift.x)
                      : times(b.x > a.x ? Sign::Positive : Sign::Negative, shift.y);
}

/// The plane of a triangle, by exact numbers: normal . (point - corner) = 0.
struct ExactPlane {
    explicit ExactPlane(const std::array<Point3, 3>& t) :
        corner(polynomial::cartesian<Exact>(t[0])),
        normal(
            polynomial::cross(polynomial::difference(polynomial::cartesian<Exact>(t[1]), corner),
                              polynomial::difference(polynomial::cartesian<Exact>(t[2]), corner))) {
    }

    /// Returns normal.z times the height at a place.
    [[nodiscard]] Exact scaled_height(const Point3& p) const {
        return corner.z * normal.z - normal.x * (Exact(p.x) - corner.x) -
               normal.y * (Exact(p.y) - corner.y);
    }

    polynomial::Coordinates<Exact, polynomial::One> corner;
    polynomial::Vector<Exact> normal;
};

} // namespace

std::uint8_t shifts_that_meet(const std::array<Point3, 3>& t, Sign turn, const Point3& p) {
    unsigned shifts = 0b1111;
    for (unsigned i = 0; i < 3 && shifts != 0; ++i) {
        const Point3 &a = t[i], &b = t[(i + 1) % 3];
        const Sign side = orient2d(Axis::z, a, b, p);
        if (side == -turn) return 0;
        if (side == turn) continue;
        for (unsigned k = 0; k < vertical_shifts.size(); ++k)
            if (side_of_shift(a, b, vertical_shifts[k]) != turn) shifts &= ~(1U << k);
    }
    return static_cast<std::uint8_t>(shifts);
}

std::array<double, 2> fall_of(const std::array<Point3, 3>& t) {
    const ExactPlane plane(t);
    return {nearest_quotient(plane.normal.x, plane.normal.z),
            nearest_quotient(plane.normal.y, plane.normal.z)};
}

VerticalHeight::VerticalHeight(const std::array<Point3, 3>& t, const Point3& p) :
    corners_(t), place_(p), z_(t[0].z) {
    const auto& [a, b, c] = t;
    for (const Point3& corner : t)
        if (corner.x == p.x && corner.y == p.y) {
            z_ = corner.z;
            return;
        }
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    if (low == high) return;
    // The error of a sum of products is a few roundings of the sum of their sizes. Where one may have underflowed or
    // overflowed, and where they nearly cancel, numbers are exact.
    constexpr double roundings = 0x1p-49, accepted = 0x1p-45, smallest = 1e-100, largest = 1e100;
    const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    const double x = p.x - a.x, y = p.y - a.y;
    const double area = u.x * v.y - v.x * u.y,
                 area_size = std::abs(u.x * v.y) + std::abs(v.x * u.y);
    const double rise = (x * v.y - v.x * y) * u.z + (u.x * y - x * u.y) * v.z;
    const double rise_size = (std::abs(x * v.y) + std::abs(v.x * y)) * std::abs(u.z) +
                             (std::abs(u.x * y) + std::abs(x * u.y)) * std::abs(v.z);
    const double most = std::max(std::abs(low), std::abs(high));
    const double sure = std::abs(area) - roundings * area_size;
    error_ = (roundings * rise_size + std::abs(rise / area) * roundings * area_size) / sure +
             roundings * most;
    if (sure > 0 && area_size > smallest && area_size < largest && most > smallest &&
        rise_size < largest && error_ < accepted * most) {
        z_ = std::clamp(a.z + rise / area, low, high);
        return;
    }
    const ExactPlane plane(t);
    z_ = nearest_quotient(plane.scaled_height(p), plane.normal.z);
    error_ = roundings * std::abs(z_) + std::numeric_limits<double>::denorm_min();
}

Sign VerticalHeight::compare(const VerticalHeight& other) const {
    const double difference = z_ - other.z_;
    if (std::abs(difference) > (error_ + other.error_) * 1.01) return sign_of(difference);
    if (error_ == 0 && other.error_ == 0) return Sign::Zero;
    const ExactPlane own(corners_), its(other.corners_);
    const Sign sign = exact_sign(own.scaled_height(place_) * its.normal.z -
                                 its.scaled_height(place_) * own.normal.z);
    return sign * exact_sign(own.normal.z) * exact_sign(its.normal.z);
}

Sign VerticalHeight::compare(const VerticalHeight& other, const VerticalShift& shift) const {
    if (const Sign sign = compare(other); sign != Sign::Zero) return sign;
    const ExactPlane own(corners_), its(other.corners_);
    const Sign turns = exact_sign(own.normal.z) * exact_sign(its.normal.z);
    const auto steeper = [&](const Exact& one, const Exact& two,
                             int way) { // heights fall along normals
        return times(exact_sign(two * own.normal.z - one * its.normal.z) * turns, way);
    };
    const Sign along_x = steeper(own.normal.x, its.normal.x, shift.x);
    return along_x != Sign::Zero ? along_x : steeper(own.normal.y, its.normal.y, shift.y);
}

std::vector<VerticalCrossing> in_order(std::vector<VerticalCandidate> candidates) {
    std::sort(candidates.begin(), candidates.end(),
              [](const VerticalCandidate& a, const VerticalCandidate& b) {
                  const auto &one = a.crossing, &other = b.crossing;
                  if (one.node != other.node) return one.node < other.node;
                  return one.z != other.z ? one.z < other.z : one.triangle < other.triangle;
              });
    std::vector<VerticalCrossing> ordered;
    for (std::size_t i = 0, end = 0; i < candidates.size(); i = end) {
        unsigned shifts = 0;
        for (; end < candidates.size() &&
               candidates[end].crossing.node == candidates[i].crossing.node;
             ++end)
            shifts |= candidates[end].shifts;
        unsigned k = 0;
        while ((shifts >> k & 1U) == 0) ++k;
        const auto here = std::span(candidates).subspan(i, end - i);
        const auto last =
            std::stable_partition(here.begin(), here.end(), [k](const VerticalCandidate& c) {
                return (c.shifts >> k & 1U) != 0;
            });
        std::stable_sort(
            here.begin(), last, [k](const VerticalCandidate& a, const VerticalCandidate& b) {
                return a.height.compare(b.height, vertical_shifts[k]) == Sign::Negative;
            });
        double z = here.front().crossing.z; // doubles may not fall where exact heights rise
        for (auto c = here.begin(); c != last; ++c) {
            z = std::max(z, c->crossing.z);
            ordered.push_back(c->crossing);
            ordered.back().z = z;
        }
    }
    return ordered;
}

} // namespace terrane
