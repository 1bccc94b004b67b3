// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Evaluates the polynomials of the predicates in plain doubles and bounds the rounding error of
// each. All static filters take their numbers from here. The bounds hold in any rounding mode.
//
// One operation errs by at most `unit` times its true result, in any rounding mode. Below, U, V, A,
// B and C are the largest absolute differences that enter each factor.
// (1) turn2d, degree 2. Each difference errs by unit and each product adds unit. Two products of
//     size U V with an error of 3 unit each, and a subtraction (2 unit), give 8 unit U V.
// (2) orient3d, degree 3. A minor of two products of size A B errs by 8 unit A B, as in (1).
//     Multiplying it by a third difference adds (2 A B C)(2 unit), which gives 12 unit A B C. Three
//     such terms give 36 and two additions 4 + 6: 46 unit A B C in all.
// (3) in_circle, degree 4, where M is the largest of all differences. A minor is at most 2 M^2 and
//     errs by 8 unit M^2. So does a lifted coordinate (two squares that err by 3 unit each, and a
//     sum of size 2). Their product is at most 4 M^4 and errs by 36 unit M^4. Three products give
//     108 and two additions 8 + 12: 128 unit M^4 in all.
// (4) The bounds hold unless products overflow, or underflow by more than the bounds leave room
// for.
//     All products of 2, 3, 4 numbers within range_of_degree2, 3, 4 are normal.
// (5) Comparing two minors of size M^2: both err by 8 unit M^2, and the sum of one of them and the
//     bound rounds by 2 unit M^2. 18 unit M^2 in all.
// The factors below also cover the terms of second order and the rounding of the bound itself.
// kernel/proofs/*.g are proofs of (1) to (5) that Gappa checks with the numbers of this file.
#pragma once

#include <terrane/kernel/config.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>

#include <terrane/kernel/point.hpp>
#include <terrane/kernel/sign.hpp>
#ifdef TERRANE_SHADOW
#include <terrane/kernel/shadow.hpp>
#define TERRANE_ASSERT_SHADOW(condition) TERRANE_ASSERT(condition)
#else
#define TERRANE_ASSERT_SHADOW(condition) static_cast<void>(0)
#endif

namespace terrane::static_filter {

constexpr double unit = std::numeric_limits<double>::epsilon();

constexpr double turn2d_factor = 9;                   ///< times unit U V, by (1)
constexpr double orient3d_factor = 48;                ///< times unit A B C, by (2)
constexpr double in_circle_factor = 132;              ///< times unit M^4, by (3)
constexpr double projection_axis_factor = 20;         ///< times unit M^2, by (5)
constexpr double normal_error_factor = turn2d_factor; ///< times unit (A B + B C + C A), by (1)
constexpr double smallest_normal_error = 0x1p-1000;   ///< more than underflow can hide

/// The open range of sizes for which the bounds hold.
struct Range {
    double low, high;

    [[nodiscard]] bool contains(double least, double largest) const {
        return least > low && largest < high;
    }
};
constexpr Range range_of_degree2{0x1p-480, 0x1p+500};
constexpr Range range_of_degree3{0x1p-320, 0x1p+330};
constexpr Range range_of_degree4{0x1p-240, 0x1p+250};

/// A computed value and the bound of its error.
struct Estimate {
    double value, bound;

    /// Returns the sign of the true value if the bound decides it; never Zero.
    [[nodiscard]] std::optional<Sign> sign() const {
        if (value > bound) return Sign::Positive;
        if (value < -bound) return Sign::Negative;
        return std::nullopt;
    }
};

/// A point of a projection along an axis: the two coordinates that follow the axis cyclically.
struct Uv {
    double u, v;

    friend auto operator<=>(const Uv&, const Uv&) = default; ///< lexicographic
};

/// Projects a point along an axis.
inline Uv project(Axis axis, const Point3& p) {
    switch (axis) {
    case Axis::x:
        return {p.y, p.z};
    case Axis::y:
        return {p.z, p.x};
    default:
        return {p.x, p.y};
    }
}

/// The cross product of b - a and d - c, with the bound (1).
class Turn2d {
public:
    Turn2d(const Uv& a, const Uv& b, const Uv& c, const Uv& d) :
#ifdef TERRANE_SHADOW
        twin_(shadow::turn2d(a, b, c, d)),
#endif
        bu_(b.u - a.u), bv_(b.v - a.v), cu_(d.u - c.u), cv_(d.v - c.v),
        u_(std::max(std::fabs(bu_), std::fabs(cu_))), v_(std::max(std::fabs(bv_), std::fabs(cv_))) {
    }

    /// Whether the product is zero because all differences of one coordinate are.
    [[nodiscard]] bool is_zero() const {
        return u_ == 0 || v_ == 0;
    }
    /// Whether the estimate has a bound.
    [[nodiscard]] bool in_range() const {
        return range_of_degree2.contains(std::min(u_, v_), std::max(u_, v_));
    }
    /// Returns the product and its bound. Precondition: in_range().
    [[nodiscard]] Estimate estimate() const {
        const Estimate e{bu_ * cv_ - bv_ * cu_, turn2d_factor * unit * u_ * v_};
        TERRANE_ASSERT_SHADOW(twin_.is_near(shadow::Twin(e.value), e.bound));
        return e;
    }
    /// Returns |u| + |v| of b - a.
    [[nodiscard]] double length() const {
        return std::fabs(bu_) + std::fabs(bv_);
    }

private:
#ifdef TERRANE_SHADOW
    shadow::Twin twin_;
#endif
    double bu_, bv_, cu_, cv_, u_, v_;
};

/// The plane of three points, for orient3d with many fourth points.
class Plane {
public:
    Plane(const Point3& a, const Point3& b, const Point3& c) : origin_(a) {
#ifdef TERRANE_SHADOW
        points_ = {a, b, c};
#endif
        const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
        const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
        normal_ = {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx};
        largest_ = {std::max(std::fabs(bx), std::fabs(cx)), std::max(std::fabs(by), std::fabs(cy)),
                    std::max(std::fabs(bz), std::fabs(cz))};
    }

    /// The determinant of a fourth point.
    class Determinant {
    public:
        Determinant(const Plane& plane, const Point3& p) :
#ifdef TERRANE_SHADOW
            twin_(shadow::orient3d(plane.points_[0], plane.points_[1], plane.points_[2], p)),
#endif
            normal_(plane.normal_), d_{p.x - plane.origin_.x, p.y - plane.origin_.y,
                                       p.z - plane.origin_.z},
            size_{std::max(plane.largest_.x, std::fabs(d_.x)),
                  std::max(plane.largest_.y, std::fabs(d_.y)),
                  std::max(plane.largest_.z, std::fabs(d_.z))} {
        }

        /// Whether the determinant is zero because all differences of one coordinate are.
        [[nodiscard]] bool is_zero() const {
            return size_.x == 0 || size_.y == 0 || size_.z == 0;
        }
        /// Whether the estimate has a bound.
        [[nodiscard]] bool in_range() const {
            const auto& [x, y, z] = size_;
            return range_of_degree3.contains(std::min(std::min(x, y), z),
                                             std::max(std::max(x, y), z));
        }
        /// Returns the determinant and its bound (2). Precondition: in_range().
        [[nodiscard]] Estimate estimate() const {
            const auto& [x, y, z] = size_;
            const Estimate e{normal_.x * d_.x + normal_.y * d_.y + normal_.z * d_.z,
                             orient3d_factor * unit * x * y * z};
            TERRANE_ASSERT_SHADOW(twin_.is_near(shadow::Twin(e.value), e.bound));
            return e;
        }

    private:
#ifdef TERRANE_SHADOW
        shadow::Twin twin_;
#endif
        const Point3& normal_;
        Point3 d_, size_;
    };

    [[nodiscard]] Determinant determinant(const Point3& p) const {
        return {*this, p};
    }
    [[nodiscard]] const Point3& normal() const {
        return normal_;
    }
    /// Bounds the sum of the errors of the normal's coordinates.
    [[nodiscard]] double normal_error() const {
        const auto& [x, y, z] = largest_;
        return normal_error_factor * unit * (x * y + y * z + z * x) + smallest_normal_error;
    }

private:
#ifdef TERRANE_SHADOW
    std::array<Point3, 3> points_;
#endif
    Point3 origin_, normal_, largest_; ///< largest_: largest absolute differences from origin_
};

} // namespace terrane::static_filter
