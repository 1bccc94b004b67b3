// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <terrane/algorithms/core/stopwatch.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/styles.hpp>

namespace terrane::cli {

/// Says messages on the terminal and keeps them, with times, for log.txt.
class Journal {
public:
    void say(std::string_view text) {
        terrane::cli::say(stdout, text);
        log_ += without_marks(text);
    }
    /// Writes to the log only.
    void note(std::string_view text) { log_ += fmt::format("[{:9.2f} s] {}\n", seconds(), text); }

    /// Returns the seconds since the journal was made.
    double seconds() { return seconds_ += watch_.lap(); }
    [[nodiscard]] const std::string& log() const { return log_; }

private:
    Stopwatch watch_;
    double seconds_ = 0;
    std::string log_;
};

} // namespace terrane::cli
