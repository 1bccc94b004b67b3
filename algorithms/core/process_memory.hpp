// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace terrane {

/// For programs whose main work is this library's: freed memory stays with the process, to be used
/// again by any of its threads. The C library would give each large array back to the system, and
/// then a fifth to two fifths of arranging large surfaces goes into page faults (pair1_680k:
/// 0.104 s with, 0.076 s without); and where each thread has an arena of its own, that of a second
/// one holds no array above 64 MiB (two threads, pair1_6800k: 0.74 s, with one arena 0.36 s;
/// rectangles_1000, of many small ones: 0.094 s, with one 0.098 s). Settings of the whole process,
/// so the library itself leaves them alone. To be called before threads are started.
inline void keep_freed_memory() {
#if defined(__GLIBC__)
    constexpr int never = 1 << 30;
    mallopt(M_MMAP_THRESHOLD, never);
    mallopt(M_TRIM_THRESHOLD, never);
    mallopt(M_ARENA_MAX, 1);
#endif
}

/// For programs: makes GMP throw std::bad_alloc where memory is short. A stage that returns a Result
/// then returns ErrorCode::out_of_memory. Without this call GMP writes "GNU MP: Cannot allocate
/// memory" to standard error and ends the process by abort(). The setting holds for the whole process,
/// so the library itself does not make it. To be called before threads are started.
///
/// Returns false, and changes nothing, if the process has given GMP other functions than GMP's own.
///
/// (1) The library stays sound after the exception: its numbers can be destroyed, and its stages can
///     be called again. Memory that GMP holds for the operation in hand may be lost.
/// (2) The exception passes through GMP, which is C. Its functions need unwind tables for that, as
///     they have on x86-64 and arm64 Linux; elsewhere the exception ends the process.
bool throw_on_gmp_out_of_memory();

} // namespace terrane
