// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <terrane/kernel/config.hpp>

#include <cmath>
#include <limits>
#include <optional>

#include <terrane/kernel/sign.hpp>
#ifdef TERRANE_SHADOW
#include <terrane/kernel/shadow.hpp>
#endif

namespace terrane {

/// What the bounds of DoubleDouble allow for rounding, in units of 2^-52 unless said otherwise.
/// kernel/proofs/twofold_*.g are proofs that Gappa checks with these numbers.
namespace twofold {
inline constexpr double sum_factor = 2;         ///< times the sizes of the low parts that are added
inline constexpr double product_factor = 2;     ///< likewise
inline constexpr double renormalised = 0x1p-40; ///< share of a bound that its computation may lose
inline constexpr double divisor_factor = 4;     ///< of the high part of a divisor
inline constexpr double quotient_factor = 8;    ///< of the bound of a remainder's quotient
inline constexpr double size_factor = 4;        ///< of the sum of the low part and the bound
} // namespace twofold

/// A number of about 106 bits with a running error bound: the true value is within err of hi + lo.
/// The bound holds only in the rounding mode "to nearest". Overflow makes err infinite or NaN;
/// nearest() then returns std::nullopt. Source: Dekker (1971) for the sums and products; the bounds
/// are derived at each operation.
class DoubleDouble {
public:
    DoubleDouble() = default;
    explicit DoubleDouble(double d) : hi_(d) { has_twin(d); }

    friend DoubleDouble operator-(const DoubleDouble& a) {
        return DoubleDouble(-a.hi_, -a.lo_, a.err_).stands_for([&] { return -a.twin(); });
    }

    // Two numbers hold the sum of the high parts exactly. Adding the three low parts rounds three
    // times, each time by at most unit / 2 times the terms added.
    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
        const double s = a.hi_ + b.hi_, t = s - a.hi_;
        const double rest = (a.hi_ - (s - t)) + (b.hi_ - t);
        const double low = rest + (a.lo_ + b.lo_);
        const double lost = std::fabs(rest) + std::fabs(a.lo_) + std::fabs(b.lo_);
        return normal(s, low, a.err_ + b.err_ + twofold::sum_factor * unit * lost).stands_for([&] {
            return a.twin() + b.twin();
        });
    }
    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

    // Two numbers hold the product of the high parts exactly (fma). The product of the low parts is
    // omitted; the mixed terms and their sum are rounded. The product of two doubles is exact
    // unless it underflows.
    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
        if (a.is_zero() || b.is_zero()) return {};
        const double p = a.hi_ * b.hi_, rest = std::fma(a.hi_, b.hi_, -p);
        const double m = a.hi_ * b.lo_, n = a.lo_ * b.hi_;
        const double lost = std::fabs(rest) + std::fabs(m) + std::fabs(n);
        const double err = a.size() * b.err_ + b.size() * a.err_ + a.err_ * b.err_ +
                           std::fabs(a.lo_ * b.lo_) + twofold::product_factor * unit * lost +
                           underflow;
        const bool is_exact = a.is_double() && b.is_double() && std::fabs(p) > least_product;
        return normal(p, rest + (m + n), is_exact ? 0 : err).stands_for([&] {
            return a.twin() * b.twin();
        });
    }

    // The result is the sum of two quotients of high parts. The remainder bounds its error.
    friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
        if (a.is_zero()) return {};
        const DoubleDouble first(a.hi_ / b.hi_);
        const DoubleDouble left = a - first * b;
        const DoubleDouble second(left.hi_ / b.hi_);
        const DoubleDouble open = left - second * b;
        DoubleDouble q = first + second;
        const auto quotient = [&] { return a.twin() / b.twin(); };
        if (open.is_zero()) return q.stands_for(quotient);
        const double divisor =
            std::fabs(b.hi_) * (1 - twofold::divisor_factor * unit) - std::fabs(b.lo_) - b.err_;
        q.err_ += (divisor > 0 ? (open.size() + open.err_) / divisor : HUGE_VAL) *
                      (1 + twofold::quotient_factor * unit) +
                  least;
        return q.stands_for(quotient);
    }

    /// Returns the double nearest to the true value if the error bound decides which one it is.
    [[nodiscard]] std::optional<double> nearest() const {
        if (is_double()) return hi_ + 0.0; // never -0
        const double above = (std::nextafter(hi_, HUGE_VAL) - hi_) / 2;
        const double below = (hi_ - std::nextafter(hi_, -HUGE_VAL)) / 2;
        const double err = err_ * (1 + 8 * unit);
        if (lo_ + err < above * (1 - 4 * unit) && -lo_ + err < below * (1 - 4 * unit)) return hi_;
        return std::nullopt;
    }

    /// Whether the true value is certainly the double value().
    [[nodiscard]] bool is_double() const { return lo_ == 0 && err_ == 0; }

    /// Whether the true value may be the double value().
    [[nodiscard]] bool may_be_double() const { return !(std::fabs(lo_) > err_); }

    /// Returns the sign of the true value if the error bound decides it.
    [[nodiscard]] std::optional<Sign> sign() const {
        if (is_zero()) return Sign::Zero;
        if (!(std::fabs(hi_) > error()) || std::isinf(hi_)) return std::nullopt;
        return hi_ > 0 ? Sign::Positive : Sign::Negative;
    }

    /// Whether the true value is certainly value() + low().
    [[nodiscard]] bool is_exact() const {
        return err_ == 0 && std::isfinite(hi_) && std::isfinite(lo_);
    }

    /// Returns the high part.
    [[nodiscard]] double value() const { return hi_; }
    /// Returns the low part.
    [[nodiscard]] double low() const { return lo_; }
    /// Returns an upper bound of the distance between the true value and value().
    [[nodiscard]] double error() const {
        return (std::fabs(lo_) + err_) * (1 + twofold::size_factor * unit);
    }

private:
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    // A constant: with -frounding-math, gcc would convert denorm_min() from an x87 number in each
    // call, and processors are slow to make a subnormal number so.
    static constexpr double least = std::numeric_limits<double>::denorm_min();
    static constexpr double underflow = 0x1p-1000;    ///< exceeds the error of underflow
    static constexpr double least_product = 0x1p-900; ///< larger products of two doubles are exact
                                                      ///< in two normal numbers

    DoubleDouble(double hi, double lo, double err) : hi_(hi), lo_(lo), err_(err) {}

    /// Renormalises high + low, where |high| >= |low| up to rounding. The factor on the bound
    /// covers the rounding of the bound itself.
    static DoubleDouble normal(double high, double low, double err) {
        const double s = high + low, t = s - high;
        return {s, (high - (s - t)) + (low - t), err * (1 + twofold::renormalised)};
    }

    // The exact twin exists in shadow builds only; elsewhere these functions do nothing.
#ifdef TERRANE_SHADOW
    [[nodiscard]] const shadow::Twin& twin() const {
        return twin_;
    }
    void has_twin(double d) {
        twin_ = shadow::Twin(d);
    }
    template <class MakeTwin>
    DoubleDouble& stands_for(const MakeTwin& make_twin) {
        twin_ = make_twin();
        TERRANE_ASSERT(twin_.is_near(shadow::Twin(hi_) + shadow::Twin(lo_), err_));
        return *this;
    }
    shadow::Twin twin_;
#else
    static int twin() {
        return 0;
    }
    static void has_twin(double) {}
    template <class MakeTwin>
    DoubleDouble& stands_for(const MakeTwin&) {
        return *this;
    }
#endif

    [[nodiscard]] bool is_zero() const {
        return hi_ == 0 && lo_ == 0 && err_ == 0;
    }
    [[nodiscard]] double size() const {
        return std::fabs(hi_) + std::fabs(lo_);
    }

    double hi_ = 0, lo_ = 0, err_ = 0;
};

#if defined(__x86_64__) && defined(__GNUC__)
inline const bool has_fma = __builtin_cpu_supports("fma") != 0;

/// Calls work with the processor's fused multiply-add in place of the C library's, which gives the
/// same numbers.
template <class Work>
[[gnu::target("fma"), gnu::flatten, gnu::noinline]] auto call_with_fma(const Work& work) {
    return work();
}
#else
constexpr bool has_fma = false;
template <class Work>
auto call_with_fma(const Work& work) {
    return work();
}
#endif

/// Returns what work computes in DoubleDouble. The caller holds the default rounding mode. Neither
/// way is inlined, so that no operation moves out of that mode.
template <class Work>
[[gnu::noinline]] auto in_twofold(const Work& work) {
    return has_fma ? call_with_fma(work) : work();
}

} // namespace terrane
