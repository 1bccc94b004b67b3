// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/run.hpp>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <set>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmp.h>
#include <mpfr.h>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/mesh.hpp>
#include <terrane/algorithms/volumes/volumes.hpp>

#include "support/effort.hpp"

using namespace terrane;

namespace {

/// Returns the waitpid status of a child that does the work, which must use nothing of Catch.
int status_of_child(const std::function<int()>& work) {
    const pid_t pid = fork();
    if (pid == 0) {
        std::signal(SIGABRT, SIG_DFL); // Catch would report it
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(9);
        _exit(work());
    }
    int status = -1;
    waitpid(pid, &status, 0);
    return status;
}

// ---- Functions that fail on request

long countdown = -1;    ///< allocations until one fails; negative: none does
std::set<void*> living; ///< blocks that GMP has

void count_down() {
    if (countdown == 0) throw std::bad_alloc();
    if (countdown > 0) --countdown;
}

void* allocate(std::size_t size) {
    count_down();
    void* const made = std::malloc(size);
    living.insert(made);
    return made;
}

void* reallocate(void* old, std::size_t, std::size_t size) {
    count_down();
    living.erase(old);
    void* const made = std::realloc(old, size);
    living.insert(made);
    return made;
}

void release(void* memory, std::size_t) {
    living.erase(memory);
    std::free(memory);
}

/// Makes GMP use these functions while it lives; then frees the memory that GMP lost.
class FailingFunctions {
public:
    FailingFunctions() { mp_set_memory_functions(allocate, reallocate, release); }
    ~FailingFunctions() {
        countdown = -1;
        mpfr_free_cache();
        mp_set_memory_functions(nullptr, nullptr, nullptr);
        for (void* const lost : living) std::free(lost);
        living.clear();
    }
    FailingFunctions(const FailingFunctions&) = delete;
    FailingFunctions& operator=(const FailingFunctions&) = delete;
};

/// Returns a box whose volume lies halfway between two doubles: only exact numbers give the nearest
/// one.
Mesh box_with_tied_volume() {
    const double a = 1 + 0x1p-26, b = 1 + 0x1p-27; // a b = 1 + 2^-26 + 2^-27 + 2^-53
    Mesh mesh;
    mesh.surfaces = {{"box", Role::unknown}};
    for (unsigned k = 0; k < 8; ++k)
        mesh.vertices.push_back({k & 1U ? a : 0, k & 2U ? b : 0, k & 4U ? 1.0 : 0});
    for (const auto& [p, q, r, s] : std::array<std::array<std::uint32_t, 4>, 6>{{{0, 2, 3, 1},
                                                                                 {4, 5, 7, 6},
                                                                                 {0, 1, 5, 4},
                                                                                 {2, 6, 7, 3},
                                                                                 {0, 4, 6, 2},
                                                                                 {1, 3, 7, 5}}}) {
        mesh.triangles.insert(mesh.triangles.end(), {{p, q, r}, {p, r, s}});
        for (int k = 0; k < 2; ++k) mesh.surfaces_of.push_back(std::array<std::uint32_t, 1>{0});
    }
    return mesh;
}

} // namespace

#ifndef TERRANE_SANITIZED // AddressSanitizer itself needs more address space than this limit

namespace {

/// Computes 2 to the power of 2^35, which takes 4 GiB; the process may have 3.
int ask_for_too_much() {
    const rlimit limit{std::size_t{3} << 30U, std::size_t{3} << 30U};
    setrlimit(RLIMIT_AS, &limit);
    mpz_t power;
    mpz_init(power);
    try {
        mpz_ui_pow_ui(power, 2, 1UL << 35U);
    } catch (const std::bad_alloc&) {
        mpz_set_ui(power, 7); // the number can still be used
        const bool sound = mpz_cmp_ui(power, 7) == 0;
        mpz_clear(power);
        return sound ? 3 : 4;
    }
    return 0;
}

} // namespace

TEST_CASE("memory: GMP ends the process where it gets none, unless it was told to throw",
          "[core]") {
    const int untold = status_of_child(ask_for_too_much);
    CHECK(WIFSIGNALED(untold));
    CHECK(WTERMSIG(untold) == SIGABRT);
    const int told =
        status_of_child([] { return throw_on_gmp_out_of_memory() ? ask_for_too_much() : 5; });
    CHECK(WIFEXITED(told));
    CHECK(WEXITSTATUS(told) == 3); // std::bad_alloc
}
#endif

TEST_CASE("memory: allocation functions of the program's own are left alone", "[core]") {
    const int status = status_of_child([] {
        if (!throw_on_gmp_out_of_memory() || !throw_on_gmp_out_of_memory())
            return 1; // a second call is allowed
        mp_set_memory_functions(allocate, reallocate, release);
        if (throw_on_gmp_out_of_memory()) return 2;
        void* (*found)(std::size_t) = nullptr;
        mp_get_memory_functions(&found, nullptr, nullptr);
        return found == allocate ? 0 : 3;
    });
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("memory: whichever allocation of GMP fails, a stage says so and stays sound", "[core]") {
    const Mesh mesh = box_with_tied_volume();
    const auto low = mpfr_get_emin(), high = mpfr_get_emax();
    const FailingFunctions failing;
    long failures = 0;
    for (long n = 0;; ++n) {
        mpfr_free_cache(); // frees the numbers that MPFR caches
        const std::size_t before = living.size();
        countdown = n;
        const auto volumes = find_volumes(mesh);
        countdown = -1;
        INFO(n);
        mpfr_free_cache();
        // A constructor of gmpxx.h that fails halfway leaks its numerator and denominator.
        REQUIRE(living.size() - before <= (volumes ? 0 : 2));
        REQUIRE(mpfr_get_emin() == low);
        REQUIRE(mpfr_get_emax() == high);
        if (volumes) {
            CHECK(volumes.value().measures == std::vector<double>{HUGE_VAL, 1 + 0x1p-26 + 0x1p-27});
            break;
        }
        ++failures;
        REQUIRE(volumes.error().code == ErrorCode::out_of_memory);
    }
    CHECK(failures > 20);
}
