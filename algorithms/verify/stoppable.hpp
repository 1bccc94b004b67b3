// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Stops the verifier. Its functions return verdicts, which a stop request does not change; so a stop unwinds them.
#pragma once

#include <cstdint>
#include <stop_token>
#include <utility>

#include <terrane/algorithms/core/result.hpp>

namespace terrane {

namespace verifier {

/// The request to which the verifier listens in one thread.
struct StopRequest {
    std::stop_token token;
    std::uint64_t looks = 0; ///< how often it was looked for
};

/// That of this thread; nullptr: nobody stops it.
inline thread_local StopRequest* stop_request = nullptr;

/// Unwinds the verifier.
struct Stopped {};

/// Throws Stopped if a stop is requested. Each operation on exact numbers and each token of a file calls it, so that loops
/// need not. Cost: nanoseconds.
inline void look_for_stop() {
    StopRequest* const request = stop_request;
    if (request == nullptr) return;
    ++request->looks;
    if (request->token.stop_requested()) throw Stopped();
}

} // namespace verifier

/// Returns what work() returns, a Result. Functions of the verifier that it calls in this thread end when the stop is
/// requested; then the error is interrupted. `looks` gets the number of times that they looked for it.
template <class Work>
auto stoppable(const std::stop_token& stop, const Work& work, std::uint64_t* looks = nullptr)
    -> decltype(work()) {
    struct Scope {
        verifier::StopRequest request;
        verifier::StopRequest* before;
        explicit Scope(const std::stop_token& token) :
            request{token}, before(std::exchange(verifier::stop_request, &request)) {}
        ~Scope() { verifier::stop_request = before; }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
    } scope(stop);
    try {
        auto made = work();
        if (looks != nullptr) *looks = scope.request.looks;
        return made;
    } catch (const verifier::Stopped&) {
        return Error{ErrorCode::interrupted, "", ""};
    }
}

} // namespace terrane
