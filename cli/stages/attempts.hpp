// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs a command of the shell on one file after the other, each in a process of its own.
#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include <sys/types.h>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::cli {

/// Runs a command on the file of each attempt.
class Attempts {
public:
    /// In the command {} stands for the file; without {}, the file is appended. `seconds` is the time of one run.
    Attempts(const std::string& command, const std::filesystem::path& file, double seconds,
             std::stop_token stop);

    /// Runs the command and returns how it ended: "status 1", "signal 11", or "no end within the limit". Its output
    /// is discarded. The processes that it started in its group are ended. Errors: interrupted; cannot_open if it
    /// could not be started.
    Result<std::string> run() const;

private:
    [[nodiscard]] Result<std::string> end_of(pid_t child) const;

    std::string line_; ///< of the shell
    double seconds_;
    std::stop_token stop_;
};

} // namespace terrane::cli
