// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/session.hpp>

#include <algorithm>
#include <csignal>
#include <ctime>

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/file_set.hpp>

namespace terrane::cli {
namespace {

/// Ends the watcher's sleep. By default the signal is ignored, so no other program is disturbed.
constexpr int wake_signal = SIGURG;

/// How long a stage may go on after an interrupt. Stages look for stop requests between steps, some
/// of which are long: the solution of a dense system, say.
constexpr std::chrono::milliseconds patience{700};

bool is_ignored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// Returns the signals that the watcher waits for; all threads block them.
sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    if (!is_ignored(SIGHUP)) sigaddset(&set, SIGHUP); // nohup ignores it
    sigaddset(&set, wake_signal);
    return set;
}

} // namespace

Session::Session(unsigned threads) :
    terminal_(isatty(STDERR_FILENO) == 1), started_(std::chrono::steady_clock::now()) {
    run_.threads = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    run_.stop = source_.get_token();
    run_.progress = [this](std::string_view stage, double share) {
        const std::lock_guard lock(mutex_);
        stage_ = stage;
        share_ = share;
    };
    run_.timing = times_.observer();
    const auto set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    watcher_ = std::jthread([this](const std::stop_token& over) { watch(over); });
}

Session::~Session() {
    watcher_.request_stop();
    pthread_kill(watcher_.native_handle(), wake_signal); // else it would sleep until its next tick
    watcher_.join();
    clear_line();
}

void Session::begin(std::string_view stage, Phase phase) {
    phase_ = phase;
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    share_ = 0;
}

void Session::number(std::size_t stage, std::size_t stages) {
    const std::lock_guard lock(mutex_);
    number_ = fmt::format("stage {} of {}: ", stage, stages);
}

void Session::end_stage() {
    phase_ = Phase::idle;
    const std::lock_guard lock(mutex_);
    stage_.clear();
    clear_line();
}

void Session::watch(const std::stop_token& over) {
    const auto set = watched_signals();
    const timespec tick{0, 100'000'000};
    while (!over.stop_requested()) {
        const int received = sigtimedwait(&set, nullptr, &tick);
        if (received == SIGINT || received == SIGTERM || received == SIGHUP) on_interrupt();
        end_if_overdue();
        if (terminal_) show();
    }
}

void Session::on_interrupt() {
    const bool again = !source_.request_stop();
    if (!again) interrupted_ = std::chrono::steady_clock::now();
    const Phase phase = phase_;
    if ((phase == Phase::computing || phase == Phase::folder) && !again) return;
    end_at_once();
}

void Session::end_if_overdue() {
    if (!stopped() || phase_ != Phase::computing) return;
    if (std::chrono::steady_clock::now() - interrupted_ > patience) end_at_once();
}

void Session::end_at_once() {
    clear_line();
    const auto lock = remove_temporaries(); // until the end, so that no other is made
    fail({ErrorCode::interrupted, "", ""});
    _exit(static_cast<int>(ExitStatus::bad_input));
}

/// Draws the progress line, but not in the first second.
void Session::show() {
    const std::lock_guard lock(mutex_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - started_;
    if (stage_.empty() || elapsed.count() < 1) return;
    const auto share = share_ > 0 ? fmt::format(" {:.0f} %", 100 * share_) : std::string();
    print(stderr,
          fmt::format("\r\033[K{}{}{} ({:.0f} s)", number_, stage_, share, elapsed.count()));
    std::fflush(stderr);
    shown_ = true;
}

void Session::clear_line() {
    if (shown_) print(stderr, "\r\033[K");
    shown_ = false;
}

} // namespace terrane::cli
