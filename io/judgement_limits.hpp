// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Limits of time and memory for the judgement of a certificate, which anybody may have made.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include <fcntl.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include <terrane/algorithms/core/result.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane {

/// What a judgement may take.
struct JudgementLimits {
    double time = 3600;   ///< processor seconds
    double memory = 16e9; ///< bytes beyond what the process has before
};

namespace detail {

/// Returns the memory that the process has, in bytes; 0 where the system does not tell. It needs no
/// memory itself.
inline double resident_bytes() {
    std::array<char, 128> text{};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    const auto length = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (length <= 0) return 0;
    char* end = nullptr;
    std::strtol(text.data(), &end, 10); // all; the second number is the resident part
    return static_cast<double>(std::strtol(end, nullptr, 10)) *
           static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Reads a file of this size. Errors: those of read_file; out_of_memory if it is beyond the limit.
inline Result<std::string> read_within(const std::filesystem::path& path, std::uint64_t size,
                                       const JudgementLimits& limits) {
    if (static_cast<double>(size) > limits.memory)
        return Error{ErrorCode::out_of_memory, "is larger than the memory that may be used",
                     path.string()};
    return read_file(path);
}

/// Asks the thread that made it to stop when a limit is reached, or when the caller asks for it.
class JudgementWatch {
public:
    JudgementWatch(const JudgementLimits& limits, const std::stop_token& callers) :
        limits_(limits), before_(resident_bytes()), start_(seconds_of(own_clock())),
        passed_on_(callers, [this] { source_.request_stop(); }),
        thread_([this, clock = own_clock()](const std::stop_token& end) { look(clock, end); }) {}

    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

    /// Ends the watch and returns the limit that was reached, as an error.
    const std::optional<Error>& end() {
        thread_.request_stop();
        if (thread_.joinable()) thread_.join();
        return reached_;
    }

private:
    static clockid_t own_clock() {
        clockid_t clock{};
        ::pthread_getcpuclockid(::pthread_self(), &clock);
        return clock;
    }
    static double seconds_of(clockid_t clock) {
        timespec time{};
        ::clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    void look(clockid_t clock, const std::stop_token& end) {
        std::unique_lock lock(mutex_);
        while (!sleep_.wait_for(lock, end, std::chrono::milliseconds(20), [] { return false; }) &&
               !end.stop_requested()) {
            if (seconds_of(clock) - start_ > limits_.time)
                reached_ = Error{ErrorCode::timed_out, "not judged within the limit of time", ""};
            else if (resident_bytes() - before_ > limits_.memory)
                reached_ =
                    Error{ErrorCode::out_of_memory, "not judged within the limit of memory", ""};
            if (!reached_) continue;
            source_.request_stop();
            return;
        }
    }

    JudgementLimits limits_;
    double before_, start_;
    std::stop_source source_;
    std::optional<Error> reached_;
    std::mutex mutex_;
    std::condition_variable_any sleep_;
    std::stop_callback<std::function<void()>> passed_on_;
    std::jthread thread_;
};

} // namespace detail
} // namespace terrane
