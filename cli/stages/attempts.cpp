// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/attempts.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace terrane::cli {

namespace {

/// Returns the text as one word of the shell.
std::string quoted_word(const std::string& text) {
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return word + "'";
}

std::string line_of(std::string command, const std::filesystem::path& file) {
    const std::string word = quoted_word(file.string());
    if (command.find("{}") == std::string::npos) return command + " " + word;
    for (std::size_t at = 0; (at = command.find("{}", at)) != std::string::npos; at += word.size())
        command.replace(at, 2, word);
    return command;
}

/// Starts the shell in a group of its own, with the signals of a new process and without any stream.
int start(const std::string& line, pid_t& child) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, ignored;
    sigemptyset(&none);
    sigemptyset(&ignored);
    for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored, signal);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &ignored);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                              POSIX_SPAWN_SETPGROUP);
    std::array<std::string, 3> words{"sh", "-c", " " + line}; // no option, whatever it begins with
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    const int failed =
        posix_spawn(&child, "/bin/sh", &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

} // namespace

Attempts::Attempts(const std::string& command, const std::filesystem::path& file, double seconds,
                   std::stop_token stop) :
    line_(line_of(command, file)),
    seconds_(seconds), stop_(std::move(stop)) {}

Result<std::string> Attempts::run() const {
    pid_t child = 0;
    if (const int failed = start(line_, child); failed != 0)
        return Error{ErrorCode::cannot_open, std::strerror(failed), "/bin/sh"};
    auto end = end_of(child);
    kill(-child, SIGKILL); // what it left in the background would see the files of later attempts
    return end;
}

Result<std::string> Attempts::end_of(pid_t child) const {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    constexpr std::chrono::microseconds longest(10'000);
    const auto kill_it = [&] {
        kill(-child, SIGKILL);
        waitpid(child, nullptr, 0);
    };
    for (auto pause = std::chrono::microseconds(200);; pause = std::min(2 * pause, longest)) {
        int status = 0;
        if (waitpid(child, &status, WNOHANG) == child)
            return WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                       : "status " + std::to_string(WEXITSTATUS(status));
        if (stop_.stop_requested()) {
            kill_it();
            return Error{ErrorCode::interrupted, "interrupted", ""};
        }
        if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds_) {
            kill_it();
            return std::string("no end within the limit");
        }
        std::this_thread::sleep_for(pause);
    }
}

} // namespace terrane::cli
