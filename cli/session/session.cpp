// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/session.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <terrane/cli/session/console.hpp>
#include <terrane/cli/session/terminal.hpp>
#include <terrane/io/atomic/file_set.hpp>

namespace terrane::cli {
namespace {

/// Ends the watcher's sleep. By default the signal is ignored, so no other program is disturbed.
constexpr int wake_signal = SIGURG;

/// How long a stage may go on after an interrupt. Stages look for stop requests between steps, some
/// of which are long: the solution of a dense system, say, or a large file of a folder.
constexpr std::chrono::milliseconds patience{700};

/// The progress line is drawn this often at most, and not before so much time.
constexpr std::chrono::milliseconds tick{100}, first_shown{1000};

/// The signals that interrupt a command.
constexpr std::array interrupts{SIGINT, SIGTERM, SIGHUP};

/// Other signals that end a program, and that people or limits of the system send. Temporary files are
/// removed before they do.
constexpr std::array endings{SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1, SIGUSR2, SIGXCPU};

bool is_among(std::span<const int> signals, int signal) {
    return std::find(signals.begin(), signals.end(), signal) != signals.end();
}

/// Tells whether a signal ends the program. It does not where the parent process has it ignored, as
/// nohup and shells do.
bool ends_program(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

/// Returns the signals that the watcher waits for; all threads block them.
sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const std::span<const int> signals : {std::span<const int>(interrupts), {endings}})
        for (const int signal : signals)
            if (ends_program(signal)) sigaddset(&set, signal);
    sigaddset(&set, wake_signal);
    return set;
}

/// Ends the program by a signal, as if it had not been blocked.
[[noreturn]] void die_by(int signal) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, signal);
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
    raise(signal);
    _exit(static_cast<int>(ExitStatus::bad_input)); // the signal has a handler by now
}

} // namespace

Session::Session(unsigned threads) :
    shows_progress_(shows_progress()), started_(std::chrono::steady_clock::now()) {
    use_threads(threads);
    run_.stop = source_.get_token();
    run_.progress = [this](std::string_view stage, double share) {
        const std::lock_guard lock(mutex_);
        enter(stage, share);
    };
    run_.timing = [this](std::string_view stage, double seconds) { seconds_.end(stage, seconds); };
    const auto set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    watcher_ = std::jthread([this](const std::stop_token& over) { watch(over); });
}

Session::~Session() {
    watcher_.request_stop();
    pthread_kill(watcher_.native_handle(), wake_signal); // else it would sleep until its next tick
    watcher_.join();
    clear_progress();
}

void Session::use_threads(unsigned threads) {
    run_.threads = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

double Session::elapsed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

void Session::end_timed() {
    const auto now = std::chrono::steady_clock::now();
    if (!timed_.empty())
        seconds_.end(std::exchange(timed_, {}),
                     std::chrono::duration<double>(now - timed_since_).count(), now);
    timed_since_ = now;
}

void Session::begin(std::string_view stage, Phase phase) {
    end_timed();
    timed_ = stage;
    phase_ = phase;
    const std::lock_guard lock(mutex_);
    enter(stage, 0);
}

void Session::enter(std::string_view stage, double share) {
    const auto now = std::chrono::steady_clock::now();
    if (stage != stage_ || share < share_) {
        stage_ = stage;
        stage_began_ = now;
        time_left_ = TimeLeft();
    }
    share_ = share;
    time_left_.update(share, std::chrono::duration<double>(now - stage_began_).count());
}

void Session::number(std::size_t stage, std::size_t stages) {
    const std::lock_guard lock(mutex_);
    number_ = fmt::format("stage {} of {}: ", stage, stages);
}

void Session::end_stage() {
    end_timed();
    phase_ = Phase::idle;
    const std::lock_guard lock(mutex_);
    stage_.clear();
    clear_progress();
}

void Session::watch(const std::stop_token& over) {
    const auto set = watched_signals();
    const timespec pause{0, std::chrono::nanoseconds(tick).count()};
    while (!over.stop_requested()) {
        const int received = sigtimedwait(&set, nullptr, &pause);
        if (is_among(interrupts, received)) on_interrupt();
        if (is_among(endings, received)) end_by(received);
        end_if_overdue();
        if (shows_progress_) show();
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
    const Phase phase = phase_;
    if (!stopped() || (phase != Phase::computing && phase != Phase::folder)) return;
    if (std::chrono::steady_clock::now() - interrupted_ > patience) end_at_once();
}

void Session::end_at_once() {
    clear_progress();
    const auto lock = remove_temporaries(); // until the end, so that no other is made
    fail({ErrorCode::interrupted, "", ""});
    _exit(static_cast<int>(ExitStatus::bad_input));
}

void Session::end_by(int signal) {
    source_.request_stop(); // what works with temporary files must not go on without them
    clear_progress();
    const auto lock = remove_temporaries(); // until the end, so that no other is made
    die_by(signal);
}

/// Draws the progress line, but not in the first second, and at most once per tick.
void Session::show() {
    const auto now = std::chrono::steady_clock::now();
    const std::lock_guard lock(mutex_);
    if (stage_.empty() || now - started_ < first_shown || now - drawn_ < tick) return;
    drawn_ = now;
    const std::chrono::duration<double> elapsed = now - stage_began_;
    const auto left = time_left_.after(elapsed.count());
    draw_progress(fmt::format(
        "{}{}{} ({}{})", number_, stage_, share_ > 0 ? fmt::format(" {:.0f} %", 100 * share_) : "",
        duration(elapsed.count()), left ? fmt::format(", {} left", duration(*left)) : ""));
}

} // namespace terrane::cli
