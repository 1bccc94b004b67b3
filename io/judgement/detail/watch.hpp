// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Limits of time and memory for the judgement of a certificate, which anybody may have made.
#pragma once

#include <condition_variable>
#include <ctime>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/judgement/judgement.hpp>

namespace terrane::detail {

/// Asks the thread that made it to stop when a limit is reached, or when the caller asks for it.
class JudgementWatch {
public:
    JudgementWatch(const JudgementLimits& limits, const std::stop_token& callers);

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

    /// Ends the watch and returns the limit that was reached, as an error.
    const std::optional<Error>& end();

private:
    void look(clockid_t clock, const std::stop_token& end);

    JudgementLimits limits_;
    double before_, start_; ///< bytes and seconds
    std::stop_source source_;
    std::optional<Error> reached_;
    std::mutex mutex_;
    std::condition_variable_any sleep_;
    std::stop_callback<std::function<void()>> passed_on_;
    std::jthread thread_;
};

} // namespace terrane::detail
