// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/helper_process.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace terrane::tetgen::detail {
namespace {

constexpr double poll_milliseconds = 50; // longest delay in noticing a stop request
constexpr std::size_t most_said = 400;   // most characters of standard error that are kept

/// Moves both ends above the standard descriptors, some of which the caller may have closed.
/// Otherwise another thread that prints could write to the helper.
using Ends = std::array<Descriptor, 2>;

bool above_standard(Ends& ends) {
    for (Descriptor& end : ends) {
        if (end.get() > STDERR_FILENO) continue;
        end = Descriptor(fcntl(end.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
        if (!end.is_open()) return false;
    }
    return true;
}

bool make_socket(Ends& ends) {
    int both[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, both) != 0) return false;
    ends = {Descriptor(both[0]), Descriptor(both[1])};
    return above_standard(ends);
}

/// Makes a pipe. Reading from its first end never blocks.
bool make_pipe(Ends& ends) {
    int both[2];
    if (pipe2(both, O_CLOEXEC) != 0) return false;
    ends = {Descriptor(both[0]), Descriptor(both[1])};
    return above_standard(ends) && fcntl(ends[0].get(), F_SETFL, O_NONBLOCK) == 0;
}

sigset_t signals(std::initializer_list<int> members) {
    sigset_t set;
    sigemptyset(&set);
    for (const int member : members) sigaddset(&set, member);
    return set;
}

/// Sets up the helper's descriptors.
class FileActions {
public:
    FileActions() { posix_spawn_file_actions_init(&actions_); }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    int set(int talk, int errors) {
        for (const auto& [from, to] :
             {std::pair{talk, STDIN_FILENO}, std::pair{talk, STDOUT_FILENO},
              std::pair{errors, STDERR_FILENO}})
            if (const int failed = posix_spawn_file_actions_adddup2(&actions_, from, to);
                failed != 0)
                return failed;
#if defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 34)
        // Closes what the caller has opened without O_CLOEXEC.
        return posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
#endif
#endif
        return 0;
    }
    [[nodiscard]] const posix_spawn_file_actions_t* get() const {
        return &actions_;
    }

private:
    posix_spawn_file_actions_t actions_{};
};

/// Sets up the helper's signals. Those that the caller ignores stay ignored, except those of a
/// crash.
class Attributes {
public:
    Attributes() { posix_spawnattr_init(&attributes_); }
    ~Attributes() { posix_spawnattr_destroy(&attributes_); }
    Attributes(const Attributes&) = delete;
    Attributes& operator=(const Attributes&) = delete;

    int set() {
        const sigset_t crashes = signals({SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL});
        const sigset_t blocked = signals({SIGINT, SIGTERM, SIGHUP});
        if (const int failed = posix_spawnattr_setsigdefault(&attributes_, &crashes); failed != 0)
            return failed;
        if (const int failed = posix_spawnattr_setsigmask(&attributes_, &blocked); failed != 0)
            return failed;
        return posix_spawnattr_setflags(&attributes_,
                                        POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    }
    [[nodiscard]] const posix_spawnattr_t* get() const { return &attributes_; }

private:
    posix_spawnattr_t attributes_{};
};

/// Starts the program; returns 0 or the number of the error.
int spawn(const std::filesystem::path& program, int talk, int errors, pid_t& pid) {
    FileActions actions;
    if (const int failed = actions.set(talk, errors); failed != 0) return failed;
    Attributes attributes;
    if (const int failed = attributes.set(); failed != 0) return failed;
    std::string name = program.string();
    char* arguments[] = {name.data(), nullptr};
    return posix_spawn(&pid, program.c_str(), actions.get(), attributes.get(), arguments, environ);
}

Error no_process(const char* mesher) {
    return {ErrorCode::out_of_memory, fmt::format("no process could be started for {}", mesher),
            ""};
}

/// Returns the first line, without characters that a terminal would take for commands.
std::string first_line(const std::string& text) {
    std::string line = text.substr(0, text.find('\n'));
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    return line;
}

} // namespace

Descriptor::~Descriptor() {
    if (number_ >= 0) close(number_);
}

HelperProcess::~HelperProcess() {
    kill_and_reap();
}

Error HelperProcess::broken(const std::string& sentence) const {
    return {ErrorCode::internal, fmt::format("{}'s helper {}", mesher_, sentence),
            program_.string()};
}

Status HelperProcess::start() {
    Ends talk, errors;
    if (!make_socket(talk) || !make_pipe(errors)) return no_process(mesher_);
    const int failed = spawn(program_, talk[1].get(), errors[1].get(), pid_);
    if (failed == EAGAIN || failed == ENOMEM) return no_process(mesher_);
    if (failed != 0)
        return Error{ErrorCode::cannot_open,
                     fmt::format("{}'s helper can't be run: {}", mesher_,
                                 std::generic_category().message(failed)),
                     program_.string()};
    talk_ = std::move(talk[0]);
    errors_ = std::move(errors[0]);
    return Done{};
}

Status HelperProcess::check_limits() const {
    if (stop_.stop_requested())
        return Error{ErrorCode::interrupted, fmt::format("stopped while {} ran", mesher_), ""};
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
    if (taken.count() > time_limit_)
        return Error{ErrorCode::timed_out,
                     fmt::format("{} took longer than {} seconds", mesher_, time_limit_), ""};
    return Done{};
}

void HelperProcess::drain_errors() {
    std::array<char, 4096> bytes;
    ssize_t got = 0;
    while ((got = read(errors_.get(), bytes.data(), bytes.size())) > 0)
        said_.append(bytes.data(),
                     std::min(static_cast<std::size_t>(got), most_said - said_.size()));
    if (got == 0) errors_ = Descriptor(); // closed at the other end
}

/// Waits for `events` on the socket; returns those that occurred, with any hang-up.
Result<short> HelperProcess::wait_for(short events) {
    while (true) {
        if (Status within = check_limits(); !within) return within.error();
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
        const double left = std::ceil(1000 * (time_limit_ - taken.count()));
        std::array<pollfd, 2> waiting{{{talk_.get(), events, 0}, {errors_.get(), POLLIN, 0}}};
        if (poll(waiting.data(), waiting.size(),
                 static_cast<int>(std::clamp(left, 0.0, poll_milliseconds))) <= 0)
            continue;
        if (waiting[1].revents != 0) drain_errors();
        if (waiting[0].revents != 0) return waiting[0].revents;
    }
}

Status HelperProcess::send(std::span<const std::byte> bytes) {
    while (fed_ && !bytes.empty()) {
        const Result<short> ready = wait_for(POLLIN | POLLOUT);
        if (!ready) return ready.error();
        fed_ = ready.value() == POLLOUT; // otherwise the helper answers already or has ended
        if (!fed_) break;
        const ssize_t sent =
            ::send(talk_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        fed_ = sent >= 0 || errno == EAGAIN || errno == EINTR;
        if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
    return Done{};
}

Status HelperProcess::receive(std::span<std::byte> memory) {
    while (!memory.empty()) {
        if (const Result<short> ready = wait_for(POLLIN); !ready) return ready.error();
        const ssize_t got = recv(talk_.get(), memory.data(), memory.size(), MSG_DONTWAIT);
        if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
        if (got <= 0) return why_it_ended();
        heard_ = true;
        memory = memory.subspan(static_cast<std::size_t>(got));
    }
    return Done{};
}

Status HelperProcess::finish() {
    std::byte more{};
    while (true) {
        if (const Result<short> ready = wait_for(POLLIN); !ready) return ready.error();
        const ssize_t got = recv(talk_.get(), &more, 1, MSG_DONTWAIT);
        if (got > 0) return broken("says more than it should");
        if (got == 0 || (errno != EAGAIN && errno != EINTR)) break;
    }
    const Result<int> status = wait_for_exit();
    if (!status) return status.error();
    if (status.value() != 0) return why_it_ended();
    if (!fed_) return broken("answered before it had been told all");
    return Done{};
}

/// Returns the status from waitpid, or 0 if the caller's process reaps all children by itself.
Result<int> HelperProcess::wait_for_exit() {
    while (pid_ > 0) {
        int status = 0;
        const pid_t ended = waitpid(pid_, &status, WNOHANG);
        if (ended == pid_) exit_status_ = status;
        if (ended == pid_ || (ended < 0 && errno != EINTR)) pid_ = -1;
        if (pid_ < 0) break;
        if (Status within = check_limits(); !within) return within.error();
        poll(nullptr, 0, 1); // the helper closes its descriptors a moment before it ends
    }
    drain_errors();
    return exit_status_;
}

/// Returns the reason why a helper ended that sends nothing more.
Error HelperProcess::why_it_ended() {
    const Result<int> ended = wait_for_exit();
    if (!ended) return ended.error();
    const int status = ended.value();
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGKILL)
        return {ErrorCode::out_of_memory,
                fmt::format("{} was killed, most likely for want of memory", mesher_), ""};
    if (signal != 0)
        return {ErrorCode::internal, fmt::format("{} crashed (signal {})", mesher_, signal), ""};
    if (heard_) return broken("did not end as it should");
    if (said_.empty()) return {ErrorCode::internal, fmt::format("{} gave up", mesher_), ""};
    // The helper discards the mesher's own output, so that this text comes from the loader or a
    // script's shell.
    return {ErrorCode::cannot_open,
            fmt::format("{}'s helper can't be run (exit status {}): {}", mesher_,
                        WEXITSTATUS(status), first_line(said_)),
            program_.string()};
}

void HelperProcess::kill_and_reap() {
    if (pid_ <= 0) return;
    // If something else has reaped the helper, its process number may belong to another process by
    // now.
    if (waitpid(pid_, nullptr, WNOHANG) != 0) return;
    kill(pid_, SIGKILL);
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

} // namespace terrane::tetgen::detail
