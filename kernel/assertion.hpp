// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Assertions state what holds by construction. A failed assertion throws std::logic_error, which
// stages turn into ErrorCode::internal. Conditions have no side effects, and no result depends on
// them.
//
//   TERRANE_ASSERT           always on: constant cost per call of a stage
//   TERRANE_ASSERT_DEBUG     levels debug and paranoid: constant cost per access
//   TERRANE_ASSERT_PARANOID  level paranoid: may cost as much as the stage itself
//
// CMake's TERRANE_ASSERTIONS chooses the level: always, debug or paranoid.
#pragma once

#include <stdexcept>
#include <string>

#ifndef TERRANE_ASSERTION_LEVEL
#define TERRANE_ASSERTION_LEVEL 0
#endif

namespace terrane::detail {

[[noreturn]] inline void assertion_failed(const char* condition, const char* file, int line) {
    throw std::logic_error(std::string(file) + ":" + std::to_string(line) +
                           ": this does not hold: " + condition);
}

} // namespace terrane::detail

#define TERRANE_ASSERT(condition)                                                                  \
    ((condition) ? static_cast<void>(0)                                                            \
                 : ::terrane::detail::assertion_failed(#condition, __FILE__, __LINE__))

// A disabled condition is still compiled, so that it stays valid code, but never evaluated.
#if TERRANE_ASSERTION_LEVEL >= 1
#define TERRANE_ASSERT_DEBUG(condition) TERRANE_ASSERT(condition)
#else
#define TERRANE_ASSERT_DEBUG(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif

#if TERRANE_ASSERTION_LEVEL >= 2
#define TERRANE_ASSERT_PARANOID(condition) TERRANE_ASSERT(condition)
#else
#define TERRANE_ASSERT_PARANOID(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
