// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>

namespace terrane {

/// Calls `work` and returns its Result. Lack of memory and arrays beyond the largest possible
/// length become out_of_memory at `place`. The work has StandardArithmetic.
template <class Work>
auto guard_memory(std::string place, const Work& work,
                  std::string sentence = "there is not enough memory") -> decltype(work()) {
    const StandardArithmetic arithmetic;
    try {
        return work();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    return Error{ErrorCode::out_of_memory, std::move(sentence), std::move(place)};
}

/// Runs a stage and returns its Result. Lack of memory becomes out_of_memory: "not enough memory
/// for the volumes" if `purpose` is "for the volumes". A failed assertion (std::logic_error)
/// becomes `internal` at `place`.
template <class Work>
auto guarded(std::string_view purpose, std::string_view place, const Work& work)
    -> decltype(work()) {
    try {
        return guard_memory("", work, "not enough memory " + std::string(purpose));
    } catch (const std::logic_error& broken) {
        return Error{ErrorCode::internal, broken.what(), std::string(place)};
    }
}

} // namespace terrane
