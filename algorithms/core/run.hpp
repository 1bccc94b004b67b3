// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
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

// The times of stages, collected:
//
//   terrane::StageTimes times;
//   const auto arranged = terrane::arrange(surfaces, {}, {.timing = times.observer()});
//   const double seconds = times.latest("arrange/search");

/// The wall-clock time of a stage.
struct StageTime {
    std::size_t calls = 0; ///< how often the stage has ended
    double latest = 0;     ///< seconds of the call that ended last
    double total = 0;      ///< seconds of all calls
};

/// Collects what stages report to Run::timing. Several threads may use it at a time.
class StageTimes {
public:
    /// Returns an observer for Run::timing, which must not outlive this object.
    [[nodiscard]] std::function<void(std::string_view stage, double seconds)> observer();

    /// Adds one call of a stage.
    void add(std::string_view stage, double seconds);

    /// Seconds of the call that ended last; 0 for a stage that has not ended.
    [[nodiscard]] double latest(std::string_view stage) const;

    /// Returns all stages by their paths.
    [[nodiscard]] std::map<std::string, StageTime, std::less<>> all() const;

private:
    mutable std::mutex mutex_;
    std::map<std::string, StageTime, std::less<>> times_; ///< by path
};

// Settings of the whole process, for programs.

/// Keeps freed memory in the process, where all its threads can reuse it. The call is meant for
/// programs whose main work is done by this library. It changes settings of the whole process, so
/// the library never makes it itself. Call it before starting threads. It has no effect without
/// glibc.
///
/// (1) By default glibc returns each large array to the system. A fifth to two fifths of the time
///     for arranging large surfaces then goes into page faults (pair1_680k: 0.104 s by default,
///     0.076 s with this call).
/// (2) With one malloc arena per thread, arrays above 64 MiB do not fit into the arena of a second
///     thread (two threads, pair1_6800k: 0.74 s, with one arena 0.36 s; rectangles_1000, which has
///     many small arrays: 0.094 s, with one arena 0.098 s).
void keep_freed_memory();

/// Makes GMP throw std::bad_alloc when memory is short. A stage that returns a Result then returns
/// ErrorCode::out_of_memory. Without this call GMP writes "GNU MP: Cannot allocate memory" to
/// standard error and ends the process by abort(). The setting holds for the whole process, so the
/// library never makes it itself. Call it before starting threads.
///
/// Returns false, and changes nothing, if the process has replaced GMP's memory functions by
/// others.
///
/// (1) The library stays valid after the exception: its numbers can be destroyed, and its stages
///     can be called again. Memory that GMP holds for the interrupted operation may be lost.
/// (2) The exception passes through GMP, which is C. Its functions need unwind tables for that.
///     They have them on x86-64 and arm64 Linux; elsewhere the exception ends the process.
bool throw_on_gmp_out_of_memory();

} // namespace terrane
