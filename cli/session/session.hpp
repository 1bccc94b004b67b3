// SPDX-License-Identifier: LGPL-3.0-or-later
//
// One run of a command: interrupts become a stop request, progress becomes a line on the terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

#include <terrane/algorithms/core/run.hpp>
#include <terrane/cli/session/stage_seconds.hpp>
#include <terrane/cli/session/time_left.hpp>

namespace terrane::cli {

/// The phases of a command. They differ in what an interrupt (Ctrl-C, SIGTERM, SIGHUP) does. Other
/// signals end the program after it has removed its temporary files. Files get their names after the
/// session, so a program that ends in a phase has written nothing.
enum class Phase {
    idle,      ///< reading, or writing to a pipe: the program ends at once
    computing, ///< the stage is asked to stop; if it has not soon, or at a second interrupt, the
               ///< program ends
    folder,  ///< writing a folder: it is asked to stop between two files and to remove the folder;
             ///< if it has not soon, or at a second interrupt, the program ends
    writing, ///< writing a file: the program ends at once
};

/// Handles interrupts and progress for one command. It must be made before any other thread, as the
/// signals are blocked only in threads made after it.
class Session {
public:
    explicit Session(unsigned threads); ///< 0: all cores
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const Run& run() const { return run_; }
    /// Sets the number of threads of stages that begin later; 0: all cores.
    void use_threads(unsigned threads);
    /// How long the stages took that have ended.
    [[nodiscard]] const StageSeconds& seconds() const { return seconds_; }
    /// Returns the seconds since the session was made.
    [[nodiscard]] double elapsed() const;
    [[nodiscard]] bool stopped() const { return source_.stop_requested(); }

    /// Ends the stage before, shows the name of a stage and sets the phase, which decides what an
    /// interrupt does. The time up to its end counts for it, but for what its steps report.
    void begin(std::string_view stage, Phase phase);
    /// Shows "stage 2 of 5: " before the names of the stages that follow.
    void number(std::size_t stage, std::size_t stages);
    /// Ends the stage, and removes the progress line until the next one.
    void end_stage();

    /// Returns what make() returns; the time that it takes counts for a stage.
    template <class Make>
    auto timed(std::string_view stage, const Make& make) {
        begin(stage, Phase::computing);
        auto made = make();
        end_stage();
        return made;
    }

private:
    void watch(const std::stop_token& over);
    void on_interrupt();
    void end_if_overdue();
    [[noreturn]] void end_at_once();
    [[noreturn]] void end_by(int signal);
    void show();
    /// Adds the time of the stage that begin() began.
    void end_timed();
    /// Notes the stage and its share; the caller holds mutex_.
    void enter(std::string_view stage, double share);

    std::stop_source source_;
    StageSeconds seconds_;
    std::string timed_; ///< the stage that begin() began; empty: it has ended
    std::chrono::steady_clock::time_point timed_since_;
    Run run_;
    std::atomic<Phase> phase_ = Phase::idle;

    bool shows_progress_;
    std::chrono::steady_clock::time_point started_;
    std::chrono::steady_clock::time_point drawn_; ///< the progress line; the watcher's alone
    std::mutex mutex_;                            ///< guards what follows, up to share_
    std::chrono::steady_clock::time_point stage_began_;
    TimeLeft time_left_; ///< of the stage
    std::string stage_;  ///< empty: nothing to show
    std::string number_; ///< "stage 2 of 5: ", or empty
    double share_ = 0;

    std::chrono::steady_clock::time_point interrupted_; ///< when; the watcher's alone

    std::jthread watcher_; ///< last: it uses the others
};

} // namespace terrane::cli
