// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace terrane {

/// Keeps freed memory in the process, where all its threads can reuse it. The call is meant for
/// programs whose main work is done by this library. It changes settings of the whole process, so
/// the library never makes it itself. Call it before starting threads. It has no effect without
/// glibc.
///
/// (1) By default glibc returns each large array to the system. A fifth to two fifths of the time
///     for arranging large surfaces then goes into page faults (pair1_680k: 0.104 s by default,
///     0.076 s with this call).
/// (2) With one malloc arena per thread, arrays above 64 MiB do not fit into the arena of a second
///     thread (two threads, pair1_6800k: 0.74 s, with one arena 0.36 s; rectangles_1000, which has
///     many small arrays: 0.094 s, with one arena 0.098 s).
inline void keep_freed_memory() {
#if defined(__GLIBC__)
    constexpr int never = 1 << 30;
    mallopt(M_MMAP_THRESHOLD, never);
    mallopt(M_TRIM_THRESHOLD, never);
    mallopt(M_ARENA_MAX, 1);
#endif
}

/// Makes GMP throw std::bad_alloc when memory is short. A stage that returns a Result then returns
/// ErrorCode::out_of_memory. Without this call GMP writes "GNU MP: Cannot allocate memory" to
/// standard error and ends the process by abort(). The setting holds for the whole process, so the
/// library never makes it itself. Call it before starting threads.
///
/// Returns false, and changes nothing, if the process has replaced GMP's memory functions by
/// others.
///
/// (1) The library stays valid after the exception: its numbers can be destroyed, and its stages
///     can be called again. Memory that GMP holds for the interrupted operation may be lost.
/// (2) The exception passes through GMP, which is C. Its functions need unwind tables for that.
///     They have them on x86-64 and arm64 Linux; elsewhere the exception ends the process.
bool throw_on_gmp_out_of_memory();

} // namespace terrane
