// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the program says, and the status with which it ends. The library says nothing.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/kernel/point.hpp>

namespace terrane::cli {

enum class ExitStatus {
    done = 0,
    negative = 1,  ///< the answer is "no": findings, or no conforming mesh of doubles
    bad_input = 2, ///< bad input or usage, cannot read or write, interrupted
    internal = 3,  ///< a promise was broken, or out of memory
};

ExitStatus status_of(ErrorCode code);

/// Writes "terrane: basin.ts:1204: VRTX needs 3 numbers" to standard error; the status for it.
ExitStatus fail(const Error& error);

/// "terrane: warning: ..." on standard error.
void warn(std::string_view sentence);

/// Failures to write show in finish().
void print(std::FILE* stream, std::string_view text);

/// `status`, or bad_input where standard output did not take all that was printed.
ExitStatus finish(ExitStatus status);

/// "(1.5, 2, -300.25)", digits as many as it takes to read the same doubles back.
std::string text_of(const Point3& p);

/// "1 triangle", "2 triangles"
std::string counted(std::size_t count, std::string_view noun);

} // namespace terrane::cli
