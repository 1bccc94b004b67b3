// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/run.hpp>

#include <cstddef>
#include <cstdlib>
#include <new>

#include <gmp.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace terrane {
namespace {

/// GMP's memory functions.
struct Functions {
    void* (*allocate)(std::size_t) = nullptr;
    void* (*reallocate)(void*, std::size_t, std::size_t) = nullptr;
    void (*release)(void*, std::size_t) = nullptr;

    friend bool operator==(const Functions&, const Functions&) = default;
};

Functions current() {
    Functions f;
    mp_get_memory_functions(&f.allocate, &f.reallocate, &f.release);
    return f;
}

void set(const Functions& f) {
    mp_set_memory_functions(f.allocate, f.reallocate, f.release);
}

// GMP's default functions call malloc, realloc and free, and so do these: numbers allocated before
// the exchange may be freed after it.

void* allocate(std::size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void* reallocate(void* old, std::size_t, std::size_t size) {
    void* const memory = std::realloc(old, size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void release(void* memory, std::size_t) {
    std::free(memory);
}

} // namespace

void keep_freed_memory() {
#if defined(__GLIBC__)
    constexpr int never = 1 << 30;
    mallopt(M_MMAP_THRESHOLD, never);
    mallopt(M_TRIM_THRESHOLD, never);
    mallopt(M_ARENA_MAX, 1);
#endif
}

bool throw_on_gmp_out_of_memory() {
    const Functions before = current(), throwing{allocate, reallocate, release};
    if (before == throwing) return true;
    set({}); // GMP's default functions
    const bool untouched = before == current();
    set(untouched ? throwing : before);
    return untouched;
}

} // namespace terrane
