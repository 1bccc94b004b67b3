// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/judgement/detail/watch.hpp>

#include <array>
#include <chrono>
#include <cstdlib>

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

namespace terrane::detail {

namespace {

/// Returns the memory that the process has, in bytes; 0 where the system does not tell. It needs no
/// memory itself.
double resident_bytes() {
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

/// Returns the clock of the processor time of this thread.
clockid_t own_clock() {
    clockid_t clock{};
    ::pthread_getcpuclockid(::pthread_self(), &clock);
    return clock;
}

double seconds_of(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

JudgementWatch::JudgementWatch(const JudgementLimits& limits, const std::stop_token& callers) :
    limits_(limits), before_(resident_bytes()), start_(seconds_of(own_clock())),
    passed_on_(callers, [this] { source_.request_stop(); }),
    thread_([this, clock = own_clock()](const std::stop_token& end) { look(clock, end); }) {}

const std::optional<Error>& JudgementWatch::end() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    return reached_;
}

void JudgementWatch::look(clockid_t clock, const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (!sleep_.wait_for(lock, end, std::chrono::milliseconds(20), [] { return false; }) &&
           !end.stop_requested()) {
        if (seconds_of(clock) - start_ > limits_.time)
            reached_ = Error{ErrorCode::timed_out, "not judged within the limit of time", ""};
        else if (resident_bytes() - before_ > limits_.memory)
            reached_ = Error{ErrorCode::out_of_memory, "not judged within the limit of memory", ""};
        if (!reached_) continue;
        source_.request_stop();
        return;
    }
}

} // namespace terrane::detail
