// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

namespace terrane {

/// Options that control how a stage runs and never affect its result. Passed on by const&.
struct Run {
    unsigned threads = 1;   ///< >= 1; the result does not depend on it
    std::stop_token stop{}; ///< a requested stop ends the stage with ErrorCode::interrupted
    /// Receives the name of the stage and the share of it that is done, in [0, 1]; 0 as long as
    /// that is not known. It is called between steps, in the calling thread.
    std::function<void(std::string_view stage, double share)> progress{};
    /// Called when a stage, or a step of it, has ended, with its path ("arrange",
    /// "seal/arrange/search") and its wall-clock time; steps count to their stage. Calls may come
    /// from several threads at a time. StageTimes collects them.
    std::function<void(std::string_view stage, double seconds)> timing{};
};

} // namespace terrane
