// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace terrane {

/// The number of predicates that each stage decided.
struct PredicateCounts {
    std::uint64_t static_filter = 0; ///< by doubles with an error bound
    std::uint64_t interval = 0;      ///< by intervals, or by numbers of about 106 bits
    std::uint64_t exact = 0;         ///< by exact numbers

    /// Adds the counts of each stage.
    PredicateCounts& operator+=(const PredicateCounts& o) {
        static_filter += o.static_filter;
        interval += o.interval;
        exact += o.exact;
        return *this;
    }
    /// Subtracts the counts of each stage: the counts since `b`.
    friend PredicateCounts operator-(PredicateCounts a, const PredicateCounts& b) {
        a.static_filter -= b.static_filter;
        a.interval -= b.interval;
        a.exact -= b.exact;
        return a;
    }
};

} // namespace terrane
