// SPDX-License-Identifier: LGPL-3.0-or-later
#include "failing_allocator.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include <gmp.h>

namespace failing {
namespace {

std::atomic<bool> armed = false;
std::atomic<long> asked = 0;  ///< since arm()
std::atomic<long> first = -1; ///< the first allocation that fails
std::atomic<Mode> failing_mode = Mode::once;
std::atomic<long> alive = 0;

bool fails() {
    if (!armed) return false;
    const long number = asked++;
    if (first < 0) return false;
    return failing_mode == Mode::once ? number == first : number >= first;
}

/// Returns null where the allocation fails.
void* allocated(std::size_t size, std::size_t alignment) noexcept {
    if (fails()) return nullptr;
    if (size == 0) size = 1;
    void* memory = nullptr;
    if (alignment <= alignof(std::max_align_t))
        memory = std::malloc(size);
    else
        memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (memory != nullptr) ++alive;
    return memory;
}

void* needed(std::size_t size, std::size_t alignment) {
    void* const memory = allocated(size, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void released(void* memory) noexcept {
    if (memory == nullptr) return;
    --alive;
    std::free(memory);
}

// GMP's blocks are not counted as living: what an exception interrupts in GMP loses some.

void* gmp_allocate(std::size_t size) {
    void* const memory = fails() ? nullptr : std::malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void* gmp_reallocate(void* old, std::size_t, std::size_t size) {
    void* const memory = fails() ? nullptr : std::realloc(old, size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void gmp_release(void* memory, std::size_t) {
    std::free(memory);
}

} // namespace

void take_over_gmp() {
    mp_set_memory_functions(gmp_allocate, gmp_reallocate, gmp_release);
}

void arm(long n, Mode mode) {
    asked = 0;
    first = n;
    failing_mode = mode;
    armed = true;
}

long disarm() {
    armed = false;
    return asked;
}

long living() {
    return alive;
}

} // namespace failing

/// A function of GMP that an exception interrupts loses some of GMP's memory; see errors.md.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:gmp_allocate\nleak:gmp_reallocate\n";
}

// The other forms of new and delete call these.

void* operator new(std::size_t size) {
    return failing::needed(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return failing::needed(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return failing::allocated(size, 0);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
    return failing::allocated(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size) {
    return failing::needed(size, 0);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return failing::needed(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
    failing::released(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    failing::released(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    failing::released(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    failing::released(memory);
}
void operator delete[](void* memory) noexcept {
    failing::released(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    failing::released(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
    failing::released(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    failing::released(memory);
}
