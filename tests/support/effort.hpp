// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The number of random cases in a test: all of them, or one in twenty under sanitizers, which are
// slow.
#pragma once

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
inline constexpr int effort_divisor = 20;
#else
inline constexpr int effort_divisor = 1;
#endif

/// Returns `full`, or fewer under sanitizers, but at least one.
constexpr int cases(int full) {
    return full / effort_divisor > 0 ? full / effort_divisor : 1;
}

} // namespace test_support
