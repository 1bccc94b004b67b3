// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The number of random cases in a test: a quarter of them, but all of the first eight, or one in
// twenty under sanitizers, which are slow; with TERRANE_EFFORT so many times as many.
// scripts/nightly.sh runs all.
#pragma once

#include <algorithm>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TERRANE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
    __has_feature(undefined_behavior_sanitizer)
#define TERRANE_SANITIZED 1
#endif
#endif

namespace test_support {

#ifdef TERRANE_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

/// Returns so much of `full`, or more where the environment asks for it; at least one.
inline int cases(int full) {
    static const char* const wanted = std::getenv("TERRANE_EFFORT");
    static const int factor = wanted != nullptr ? std::max(1, std::atoi(wanted)) : 1;
    const int usual = is_sanitized ? full / 20 : std::max(full / 4, std::min(full, 8));
    return std::max(1, usual * factor);
}

} // namespace test_support
