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

} // namespace terrane
