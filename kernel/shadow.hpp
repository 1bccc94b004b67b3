// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Gives filtered numbers exact twins, in builds with TERRANE_SHADOW only. Each interval, each
// number with a running bound and each static estimate carries the real number that it stands for,
// and every operation checks that the bound contains it. Such builds are slow and meant for tests.
#pragma once

#include <terrane/kernel/config.hpp>

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <array>
#include <cmath>

#include <terrane/kernel/assertion.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::shadow {

/// A rational number, or unknown: an interval given by its limits alone, a number that is not
/// finite, or a quotient by zero.
class Twin {
public:
    Twin() : numerator_(0), denominator_(1) {}
    explicit Twin(double d) : denominator_(1) {
        if (std::isfinite(d))
            numerator_ = CGAL::Mpzf(d);
        else
            known_ = false;
    }
    Twin(const CGAL::Mpzf& numerator, const CGAL::Mpzf& denominator) :
        numerator_(numerator), denominator_(denominator) {
        const auto sign = CGAL::sign(denominator_);
        if (sign == CGAL::NEGATIVE) {
            numerator_ = -numerator_;
            denominator_ = -denominator_;
        }
        known_ = sign != CGAL::ZERO;
    }
    static Twin unknown() {
        Twin t;
        t.known_ = false;
        return t;
    }

    [[nodiscard]] bool is_known() const { return known_; }
    /// Whether the number lies in [low, high]. An unknown number does, and a limit that is not
    /// finite holds.
    [[nodiscard]] bool is_in(double low, double high) const {
        return !known_ ||
               ((!std::isfinite(low) || CGAL::sign((*this - Twin(low)).numerator_) >= 0) &&
                (!std::isfinite(high) || CGAL::sign((Twin(high) - *this).numerator_) >= 0));
    }
    /// Whether the number differs from `value` by at most `bound`, or either is unknown.
    [[nodiscard]] bool is_near(const Twin& value, double bound) const {
        return !value.known_ || (*this - value).is_in(-bound, bound);
    }

    friend Twin operator-(const Twin& a) {
        return a.known_ ? Twin(-a.numerator_, a.denominator_) : a;
    }
    friend Twin operator+(const Twin& a, const Twin& b) {
        if (!a.known_ || !b.known_) return unknown();
        return {a.numerator_ * b.denominator_ + b.numerator_ * a.denominator_,
                a.denominator_ * b.denominator_};
    }
    friend Twin operator-(const Twin& a, const Twin& b) { return a + -b; }
    friend Twin operator*(const Twin& a, const Twin& b) {
        if (!a.known_ || !b.known_) return unknown();
        return {a.numerator_ * b.numerator_, a.denominator_ * b.denominator_};
    }
    friend Twin operator/(const Twin& a, const Twin& b) {
        if (!a.known_ || !b.known_) return unknown();
        return {a.numerator_ * b.denominator_, a.denominator_ * b.numerator_};
    }

private:
    CGAL::Mpzf numerator_, denominator_; ///< the denominator is positive
    bool known_ = true;
};

/// CGAL's interval, with a twin.
class IntervalWithTwin {
public:
    using Plain = CGAL::Interval_nt<false>;

    IntervalWithTwin() : IntervalWithTwin(0.0) {}
    IntervalWithTwin(double d) : plain_(d), twin_(d) {} // NOLINT: implicit, as the plain one
    IntervalWithTwin(int i) :
        IntervalWithTwin(static_cast<double>(i)) {} // NOLINT: implicit, as the plain one
    IntervalWithTwin(double low, double high) : plain_(low, high), twin_(Twin::unknown()) {}
    /// Constructs the enclosure of a number that is known exactly.
    IntervalWithTwin(double low, double high, const Twin& twin) :
        IntervalWithTwin(Plain(low, high), twin) {}

    [[nodiscard]] double inf() const { return plain_.inf(); }
    [[nodiscard]] double sup() const { return plain_.sup(); }

    friend IntervalWithTwin operator-(const IntervalWithTwin& a) { return {-a.plain_, -a.twin_}; }
    friend IntervalWithTwin operator+(const IntervalWithTwin& a, const IntervalWithTwin& b) {
        return {a.plain_ + b.plain_, a.twin_ + b.twin_};
    }
    friend IntervalWithTwin operator-(const IntervalWithTwin& a, const IntervalWithTwin& b) {
        return {a.plain_ - b.plain_, a.twin_ - b.twin_};
    }
    friend IntervalWithTwin operator*(const IntervalWithTwin& a, const IntervalWithTwin& b) {
        return {a.plain_ * b.plain_, a.twin_ * b.twin_};
    }
    friend IntervalWithTwin operator/(const IntervalWithTwin& a, const IntervalWithTwin& b) {
        return {a.plain_ / b.plain_, a.twin_ / b.twin_};
    }

private:
    IntervalWithTwin(const Plain& plain, const Twin& twin) : plain_(plain), twin_(twin) {
        TERRANE_ASSERT(twin_.is_in(plain_.inf(), plain_.sup()));
    }

    Plain plain_;
    Twin twin_;
};

/// Computes the cross product of b - a and d - c in a projection; points have u and v.
template <class Uv>
Twin turn2d(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    return (Twin(b.u) - Twin(a.u)) * (Twin(d.v) - Twin(c.v)) -
           (Twin(b.v) - Twin(a.v)) * (Twin(d.u) - Twin(c.u));
}

/// Computes the determinant of b - a, c - a, d - a.
inline Twin orient3d(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    const auto minus_a = [&](const Point3& p) {
        return std::array<Twin, 3>{Twin(p.x) - Twin(a.x), Twin(p.y) - Twin(a.y),
                                   Twin(p.z) - Twin(a.z)};
    };
    const auto b_ = minus_a(b), c_ = minus_a(c), d_ = minus_a(d);
    return (b_[1] * c_[2] - b_[2] * c_[1]) * d_[0] + (b_[2] * c_[0] - b_[0] * c_[2]) * d_[1] +
           (b_[0] * c_[1] - b_[1] * c_[0]) * d_[2];
}

/// Computes the determinant of in_circle; points have u and v.
template <class Uv>
Twin in_circle(const Uv& a, const Uv& b, const Uv& c, const Uv& d) {
    const auto lifted = [&](const Uv& p) {
        const Twin u = Twin(p.u) - Twin(d.u), v = Twin(p.v) - Twin(d.v);
        return u * u + v * v;
    };
    return lifted(a) * turn2d(d, b, d, c) + lifted(b) * turn2d(d, c, d, a) +
           lifted(c) * turn2d(d, a, d, b);
}

} // namespace terrane::shadow
