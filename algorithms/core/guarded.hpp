// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>

namespace terrane {

/// Returns an error with a sentence made of two parts. Where memory does not even suffice for the
/// texts, they are left out: the rest needs none.
inline Error error_within_memory(ErrorCode code, std::string_view sentence, std::string_view more,
                                 std::string_view place) noexcept {
    Error error{code, {}, {}};
    try {
        error.sentence.reserve(sentence.size() + more.size());
        error.sentence.append(sentence).append(more);
        error.place = place;
    } catch (const std::bad_alloc&) {
        if (error.sentence.empty()) error.sentence = "out of memory"; // short: it needs no memory
    }
    return error;
}

/// Whether a thread could not be started: by the standard library, or by TBB, which has no type of
/// its own for that.
inline bool is_lack_of_threads(const std::runtime_error& refused) {
    if (const auto* error = dynamic_cast<const std::system_error*>(&refused))
        return error->code() == std::errc::resource_unavailable_try_again ||
               error->code() == std::errc::not_enough_memory;
    return std::string_view(refused.what()).starts_with("pthread_create has failed");
}

/// Calls `work` and returns its Result. Lack of memory, arrays beyond the largest possible length
/// and threads that cannot be started become out_of_memory at `place`, whatever memory is left. The
/// work has StandardArithmetic.
template <class Work>
auto guard_memory(std::string_view place, const Work& work,
                  std::string_view sentence = "there is not enough memory",
                  std::string_view more = "") -> decltype(work()) {
    const StandardArithmetic arithmetic;
    try {
        return work();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    } catch (const std::runtime_error& refused) {
        if (!is_lack_of_threads(refused)) throw;
    }
    return error_within_memory(ErrorCode::out_of_memory, sentence, more, place);
}

/// Runs a stage and returns its Result. Lack of memory becomes out_of_memory: "not enough memory
/// for the volumes" if `purpose` is "for the volumes". A failed assertion (std::logic_error)
/// becomes `internal` at `place`.
template <class Work>
auto guarded(std::string_view purpose, std::string_view place, const Work& work)
    -> decltype(work()) {
    try {
        return guard_memory("", work, "not enough memory ", purpose);
    } catch (const std::logic_error& broken) {
        return error_within_memory(ErrorCode::internal, broken.what(), "", place);
    }
}

} // namespace terrane
