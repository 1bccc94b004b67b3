// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

namespace terrane {

/// How a stage is carried out; never what it computes. Passed down by const&.
struct Run {
    unsigned threads = 1;   ///< >= 1; the result does not depend on it
    std::stop_token stop{}; ///< requested: the stage ends with ErrorCode::interrupted
    /// Called from the calling thread between steps: stage name and its share done, in [0, 1].
    std::function<void(std::string_view stage, double share)> progress{};
};

} // namespace terrane
