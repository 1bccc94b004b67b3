// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Declares the number types of the second and third stages of predicates, intervals and exact
// numbers, and the rounding modes that they need. The first stage uses doubles with a static bound.
#pragma once

#include <terrane/kernel/config.hpp>

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <optional>
#include <type_traits>

#include <terrane/kernel/predicate_counts.hpp>
#include <terrane/kernel/sign.hpp>
#ifdef TERRANE_SHADOW
#include <terrane/kernel/shadow.hpp>
#endif

namespace terrane {

/// An interval that encloses a real number; valid only under an UpwardRounding in the same thread.
/// So certain_sign asks for its witness.
#ifdef TERRANE_SHADOW
using Interval = shadow::IntervalWithTwin;
#else
using Interval = CGAL::Interval_nt<false>;
#endif

/// An exact number: sums, differences and products of doubles in double's full range. It has no
/// division.
using Exact = CGAL::Mpzf;

/// Shows that an UpwardRounding is alive in this thread. Only such a guard makes one, so a function
/// that takes a witness cannot be called without a guard. It has no data: passing it costs nothing.
/// It must not outlive its guard, leave its thread, or be used under a ToNearest inside.
class UpwardWitness {
    friend class UpwardRounding;
    constexpr explicit UpwardWitness(int) {} // not an aggregate, so {} makes none
};
static_assert(std::is_empty_v<UpwardWitness> && std::is_trivially_copyable_v<UpwardWitness>);

/// Sets the rounding mode that Interval needs, in this thread, for its lifetime. Use one per thread
/// and stage: switching costs more than a predicate. Ordinary double arithmetic rounds upward as
/// well meanwhile, so only the static filters, whose bounds hold in any mode, may use doubles.
class UpwardRounding {
public:
    UpwardRounding() = default;
    UpwardRounding(const UpwardRounding&) = delete;
    UpwardRounding& operator=(const UpwardRounding&) = delete;

    operator UpwardWitness() const& { return UpwardWitness(0); } // NOLINT: the guard is passed on
    operator UpwardWitness() const&& = delete;                   // it would outlive the guard

private:
    CGAL::Protect_FPU_rounding<true> mode_;
};

/// Returns the sign if all numbers in the interval have the same one.
inline std::optional<Sign> certain_sign(UpwardWitness, const Interval& i) {
    if (i.inf() > 0) return Sign::Positive;
    if (i.sup() < 0) return Sign::Negative;
    if (i.inf() == 0 && i.sup() == 0) return Sign::Zero;
    return std::nullopt;
}

inline Sign exact_sign(const Exact& e) {
    return static_cast<Sign>(static_cast<int>(CGAL::sign(e)));
}

/// Sets the default rounding mode for its lifetime, inside an UpwardRounding or not.
class ToNearest {
public:
    ToNearest() : before_(CGAL::FPU_get_and_set_cw(CGAL_FE_TONEAREST)) {}
    ~ToNearest() { CGAL::FPU_set_cw(before_); }
    ToNearest(const ToNearest&) = delete;
    ToNearest& operator=(const ToNearest&) = delete;

private:
    CGAL::FPU_CW_t before_;
};

/// Counts the predicates that this thread has decided so far. Take differences; never reset it.
/// (The counts are thread-local because passing a parameter to every predicate would cost more than
/// the easy predicates themselves.)
inline PredicateCounts& predicate_counts() {
    static thread_local PredicateCounts counts;
    return counts;
}

} // namespace terrane
