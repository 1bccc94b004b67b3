// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The number types of the three stages: double with a bound, interval, exact.
#pragma once

#include <terrane/kernel/config.hpp>

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <optional>

#include <terrane/kernel/predicate_counts.hpp>
#include <terrane/kernel/sign.hpp>
#ifdef TERRANE_SHADOW
#include <terrane/kernel/shadow.hpp>
#endif

namespace terrane {

/// Encloses a real number; correct only under an UpwardRounding in the same thread.
#ifdef TERRANE_SHADOW
using Interval = shadow::Interval;
#else
using Interval = CGAL::Interval_nt<false>;
#endif

/// Sums, differences and products of doubles, exactly; no division. Full range of double.
using Exact = CGAL::Mpzf;

/// The rounding mode that Interval needs, for as long as it lives, in this thread. One per thread
/// and stage: switching costs more than a predicate. Inside it, ordinary double arithmetic rounds
/// upward too: only the static filters, whose bounds hold in any mode, may be used.
using UpwardRounding = CGAL::Protect_FPU_rounding<true>;

/// The sign if all numbers in the interval have it.
inline std::optional<Sign> certain_sign(const Interval& i) {
    if (i.inf() > 0) return Sign::Positive;
    if (i.sup() < 0) return Sign::Negative;
    if (i.inf() == 0 && i.sup() == 0) return Sign::Zero;
    return std::nullopt;
}

inline Sign exact_sign(const Exact& e) {
    return static_cast<Sign>(static_cast<int>(CGAL::sign(e)));
}

/// The default rounding mode for as long as it lives, inside an UpwardRounding or not.
class ToNearest {
public:
    ToNearest() : before_(CGAL::FPU_get_and_set_cw(CGAL_FE_TONEAREST)) {}
    ~ToNearest() { CGAL::FPU_set_cw(before_); }
    ToNearest(const ToNearest&) = delete;
    ToNearest& operator=(const ToNearest&) = delete;

private:
    CGAL::FPU_CW_t before_;
};

/// What this thread has decided so far. Take differences; never reset. (Counted per thread since a
/// parameter on every predicate would cost more than the easy predicates themselves.)
inline PredicateCounts& predicate_counts() {
    static thread_local PredicateCounts counts;
    return counts;
}

} // namespace terrane
