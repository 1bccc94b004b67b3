// SPDX-License-Identifier: MIT
//
// Changes of meshes for coverage-guided fuzzers: a vertex onto another one, onto an edge or into a plane, or an ulp
// away; a triangle twice, torn off, cut, turned, or none. Bytes alone would need many lucky changes for each of these.
#pragma once

#include <terrane/fuzzing/meshes.hpp>

namespace terrane::fuzzing {

/// Changes a buffer of `size` bytes, which has room for `most`, and returns its new size, as LLVMFuzzerMutate does.
using ByteMutator = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t most);

/// Changes the mesh that bytes stand for, and writes it as a literal mesh; or, for half of the bytes that are none, and
/// where the literal mesh has no room, changes the bytes by `change_bytes` (null: by a simple one). Returns the new size,
/// at most `most`. The seed decides what is changed.
std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                   const Generator& generator, ByteMutator change_bytes = nullptr);

/// Writes triangles of two meshes to `out` as a literal mesh, often moved so that two vertices become one. Returns the
/// size, at most `most`.
std::size_t cross_over(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                       std::uint8_t* out, std::size_t most, unsigned seed,
                       const Generator& generator);

/// What AFL++ keeps from call to call.
struct AflState {
    unsigned seed = 0;
    std::vector<std::uint8_t> made; ///< the bytes that the last call returned

    /// Changes the first bytes, or crosses them with the others; `out` points to the result until the next call.
    std::size_t next(std::vector<std::uint8_t> bytes, const std::vector<std::uint8_t>& others,
                     std::uint8_t** out, std::size_t most, const Generator& generator);
};

/// What find_flaw() found.
struct Finding {
    Soup soup;             ///< empty: none was found
    std::string flaw;      ///< what `flaw` says of it; empty: none was found
    std::size_t tried = 0; ///< number of meshes
};

/// Looks for a mesh with a flaw without coverage: tries random bytes, and changes of what it tried before, `most` meshes
/// at most. `flaw` returns a sentence about a mesh in which the property does not hold, else "". Equal seeds try equal
/// meshes.
Finding find_flaw(const Generator& generator, const std::function<std::string(const Soup&)>& flaw,
                  std::size_t most, unsigned seed);

} // namespace terrane::fuzzing

/// Defines, in one source of a fuzz target, the mutators of libFuzzer and, for a library named in
/// AFL_CUSTOM_MUTATOR_LIBRARY, of AFL++. `generator` is that of the target, which reads its bytes by mesh_of().
#define TERRANE_FUZZING_MUTATORS(generator)                                                        \
    extern "C" {                                                                                   \
    __attribute__((weak)) std::size_t LLVMFuzzerMutate(std::uint8_t*, std::size_t, std::size_t);   \
    std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,    \
                                        unsigned seed) {                                           \
        return terrane::fuzzing::mutate(data, size, most, seed, generator, LLVMFuzzerMutate);      \
    }                                                                                              \
    std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* a, std::size_t size_a,               \
                                          const std::uint8_t* b, std::size_t size_b,               \
                                          std::uint8_t* out, std::size_t most, unsigned seed) {    \
        return terrane::fuzzing::cross_over({a, a + size_a}, {b, b + size_b}, out, most, seed,     \
                                            generator);                                            \
    }                                                                                              \
    void* afl_custom_init(void*, unsigned seed) {                                                  \
        return new terrane::fuzzing::AflState{seed, {}};                                           \
    }                                                                                              \
    std::size_t afl_custom_fuzz(void* state, std::uint8_t* data, std::size_t size,                 \
                                std::uint8_t** out, std::uint8_t* other, std::size_t other_size,   \
                                std::size_t most) {                                                \
        return static_cast<terrane::fuzzing::AflState*>(state)->next(                              \
            {data, data + size}, {other, other + other_size}, out, most, generator);               \
    }                                                                                              \
    void afl_custom_deinit(void* state) {                                                          \
        delete static_cast<terrane::fuzzing::AflState*>(state);                                    \
    }                                                                                              \
    }                                                                                              \
    static_assert(true, "a semicolon follows")
