// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Runs the helper program of a mesher once, from its start to its end.
#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <utility>

#include <sys/types.h>

#include <terrane/algorithms/core/result.hpp>

namespace terrane::tetgen::detail {

/// Owns a file descriptor and closes it.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor();

    [[nodiscard]] int get() const { return number_; }
    [[nodiscard]] bool is_open() const { return number_ >= 0; }

private:
    int number_;
};

/// Starts the helper, sends it data and receives its reply. The destructor kills and reaps it.
///
/// (1) A call returns within some 50 ms of a stop request and of the end of the time limit,
///     whatever the helper does.
/// (2) The helper gets three descriptors and no other: a socket as its standard input and output,
///     and a pipe as its standard error. SIGINT, SIGTERM and SIGHUP are blocked in it, as the
///     caller decides about them. No other signal is blocked, even if the caller blocks it.
/// (3) No signal reaches the caller: data that the helper does not read raise no SIGPIPE.
///
/// Errors about the helper itself, rather than about the mesher, have its path as their place:
/// cannot_open (it could not be run) and internal (it broke the protocol).
class HelperProcess {
public:
    /// `mesher` is its name in errors: "TetGen" or "Gmsh".
    HelperProcess(const char* mesher, std::filesystem::path program, double time_limit,
                  std::stop_token stop) :
        mesher_(mesher),
        program_(std::move(program)), time_limit_(time_limit), stop_(std::move(stop)) {}
    ~HelperProcess();
    HelperProcess(const HelperProcess&) = delete;
    HelperProcess& operator=(const HelperProcess&) = delete;

    Status start();

    /// Sends data. Returns early and without an error if the helper already answers or has ended;
    /// finish() fails if such an answer says that all went well.
    Status send(std::span<const std::byte> bytes);

    /// Fills the memory with received data. If the helper ends before that, the error says why.
    Status receive(std::span<std::byte> memory);

    /// Waits for the helper to end; fails if it sends more data or ends with a failure.
    Status finish();

    /// Makes an error about the helper itself.
    [[nodiscard]] Error broken(const std::string& sentence) const;

    /// The name of the mesher.
    [[nodiscard]] const char* mesher() const { return mesher_; }

private:
    Result<short> wait_for(short events);
    Status check_limits() const;
    void drain_errors();
    Result<int> wait_for_exit();
    Error why_it_ended();
    void kill_and_reap();

    const char* mesher_;
    std::filesystem::path program_;
    double time_limit_; ///< seconds
    std::stop_token stop_;
    pid_t pid_ = -1;
    Descriptor talk_;     ///< its standard input and output
    Descriptor errors_;   ///< its standard error, which this process reads
    std::string said_;    ///< the start of its standard error
    int exit_status_ = 0; ///< status from waitpid
    bool fed_ = true;     ///< whether it took all data that were sent
    bool heard_ = false;  ///< whether any data came from it
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace terrane::tetgen::detail
