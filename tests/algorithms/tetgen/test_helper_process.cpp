// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests how the helper's process ends and what it shares with the caller.
#include <terrane/algorithms/tetgen/detail/helper_process.hpp>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "support/impostor.hpp"

using namespace impostor;

namespace fs = std::filesystem;

TEST_CASE("TetGen's helper: how it ends decides the error", "[tetrahedra][helper]") {
    CHECK(Impostor("exit 0").fails().message() == "TetGen gave up");
    CHECK(Impostor("exit 1").fails().message() == "TetGen gave up");
    const Error spoke = Impostor("echo 'no such library' >&2; echo more >&2; exit 127").fails();
    CHECK(spoke.code == ErrorCode::cannot_open);
    CHECK(spoke.sentence == "TetGen's helper can't be run (exit status 127): no such library");
    CHECK_FALSE(spoke.place.empty());
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
        const Error crash = Impostor("kill -" + std::to_string(signal) + " $$").fails();
        CHECK(crash.code == ErrorCode::internal);
        CHECK(crash.message() == "TetGen crashed (signal " + std::to_string(signal) + ")");
    }
    const Error killed = Impostor("kill -KILL $$").fails();
    CHECK(killed.code == ErrorCode::out_of_memory);
    // A complete reply does not excuse such an end.
    const std::string reply = reply_of(true_output());
    CHECK(Impostor(reply, cube_input(), "kill -SEGV $$").fails().message() ==
          "TetGen crashed (signal 11)");
    CHECK(Impostor(reply, cube_input(), "exit 3").fails().code == ErrorCode::internal);
    // Much output on standard error blocks neither side.
    const Error loud = Impostor("yes no | head -c 1000000 >&2; exit 2").fails();
    CHECK(loud.code == ErrorCode::cannot_open);
    CHECK(loud.sentence.size() < 500);
}

TEST_CASE("TetGen's helper: one that never listens, never answers or never ends is killed in time",
          "[tetrahedra][helper]") {
    TetgenInput large = cube_input(); // more than a socket holds
    large.points.resize(200'000, {0.5, 0.5, 0.5});
    const std::string reply = reply_of(true_output());
    for (const bool by_stop : {false, true}) {
        const auto end = [&](const Impostor& impostor, TetgenInput input) {
            std::stop_source source;
            std::jthread later([&] {
                std::this_thread::sleep_for(std::chrono::milliseconds(200));
                if (by_stop) source.request_stop();
            });
            if (!by_stop) input.time_limit = 0.2;
            const Error error = impostor.fails(input, source.get_token());
            CHECK(error.code == (by_stop ? ErrorCode::interrupted : ErrorCode::timed_out));
        };
        end(Impostor("exec sleep 3600"), cube_input());         // answers nothing
        end(Impostor("exec sleep 3600"), large);                // reads nothing
        end(Impostor("exec sleep 3600 >&- <&-"), cube_input()); // hangs up, but goes on
        end(Impostor(reply, cube_input(), "exec sleep 3600"), cube_input()); // does not end
        end(Impostor("trap '' TERM INT; exec sleep 3600"), cube_input());
    }
}

TEST_CASE("TetGen's helper: one that leaves or speaks before it has read all is no trouble",
          "[tetrahedra][helper]") {
    TetgenInput large = cube_input();
    large.points.resize(200'000, {0.5, 0.5, 0.5});
    struct sigaction standard {};
    struct sigaction before {};
    standard.sa_handler = SIG_DFL; // SIGPIPE would end this process
    sigaction(SIGPIPE, &standard, &before);
    CHECK(Impostor("exit 0").fails(large).message() == "TetGen gave up");
    const Error early = Impostor("cat \"${0%/*}/../nothing\" 2>/dev/null; printf x").fails(large);
    CHECK(early.code == ErrorCode::internal);
    const std::string reply = reply_of(true_output());
    const Impostor hasty(reply, TetgenInput{}); // reads less than is sent
    const Error unheard = hasty.fails(large);
    CHECK(unheard.code == ErrorCode::internal);
    CHECK(contains(unheard.sentence, "before it had been told all"));
    sigaction(SIGPIPE, &before, nullptr);
}

namespace {

/// Tells whether `work` succeeds in a child process, which keeps its changes away from this one. It
/// must use nothing of Catch.
template <class Work>
bool holds_in_child(const Work& work) {
    const pid_t pid = fork();
    if (pid == 0) {
        alarm(1800);
        _exit(work() ? 0 : 1);
    }
    int status = 1;
    waitpid(pid, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool cube_is_filled(const fs::path& helper) {
    TetgenInput input = cube_input();
    input.helper = helper;
    const auto output = run_mesher(input, {});
    return output && output.value().tetrahedra.size() >= 5;
}

} // namespace

TEST_CASE("TetGen's helper: it works whichever standard streams are closed",
          "[tetrahedra][helper]") {
    const fs::path helper = find_tetgen_helper().value();
    for (unsigned closed = 0; closed < 8; ++closed) {
        INFO(closed);
        CHECK(holds_in_child([&] {
            for (int fd = 0; fd < 3; ++fd)
                if ((closed >> static_cast<unsigned>(fd) & 1U) != 0) close(fd);
            const bool filled = cube_is_filled(helper);
            bool still = true; // the child leaves nothing open
            for (int fd = 0; fd < 3; ++fd)
                if ((closed >> static_cast<unsigned>(fd) & 1U) != 0)
                    still = still && fcntl(fd, F_GETFD) == -1;
            return filled && still;
        }));
    }
}

TEST_CASE("TetGen's helper: no channel to it takes the place of a closed standard stream",
          "[tetrahedra][helper]") {
    const Impostor sleeper("exec sleep 3600");
    TetgenInput input = cube_input();
    input.helper = sleeper.path();
    input.time_limit = 1;
    CHECK(holds_in_child([&] {
        for (int fd = 0; fd < 3; ++fd) close(fd);
        const std::jthread caller([&] { (void)run_mesher(input, {}); });
        std::this_thread::sleep_for(
            std::chrono::milliseconds(300)); // the helper runs; we may print
        return fcntl(0, F_GETFD) == -1 && fcntl(1, F_GETFD) == -1 && fcntl(2, F_GETFD) == -1;
    }));
}

TEST_CASE("TetGen's helper: it works whatever signals are blocked or ignored",
          "[tetrahedra][helper]") {
    const fs::path helper = find_tetgen_helper().value();
    CHECK(holds_in_child([&] {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, nullptr);
        return cube_is_filled(helper);
    }));
    CHECK(holds_in_child([&] { // the system reaps children, so that their status is not known
        std::signal(SIGCHLD, SIG_IGN);
        std::signal(SIGPIPE, SIG_IGN);
        return cube_is_filled(helper);
    }));
}

TEST_CASE("TetGen's helper: nothing of it is left, neither processes nor descriptors",
          "[tetrahedra][helper]") {
    const auto descriptors = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    const auto before = descriptors();
    const fs::path helper = find_tetgen_helper().value();
    for (int k = 0; k < 5; ++k) CHECK(cube_is_filled(helper));
    (void)Impostor("exit 1").fails();
    TetgenInput brief = cube_input();
    brief.time_limit = 0.05;
    (void)Impostor("exec sleep 3600").fails(brief);
    CHECK(descriptors() == before);
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
    CHECK(errno == ECHILD);
}

namespace {

/// Tells whether a process runs, rather than being dead and not yet reaped.
bool runs(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto name_end = text.rfind(')');
    return name_end != std::string::npos && text.substr(name_end + 2, 1) != "Z";
}

/// Returns the first child of a process once it has become the helper; 0 if the process has ended.
pid_t helper_of(pid_t caller) {
    const auto id = std::to_string(caller);
    for (; runs(caller); std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
        pid_t child = 0;
        std::ifstream("/proc/" + id + "/task/" + id + "/children") >> child;
        std::string name;
        std::ifstream("/proc/" + std::to_string(child) + "/comm") >> name;
        if (child > 0 && name == "terrane-tetgen") return child;
    }
    return 0;
}

} // namespace

TEST_CASE(
    "TetGen's helper: it gets no descriptor and no signal mask of the caller's, and ends with it",
    "[tetrahedra][helper]") {
    TetgenInput input = cube_input();
    input.helper = find_tetgen_helper().value();
    input.keep_facets = false;
    input.max_volume = 1e-8; // minutes of work
    const pid_t caller = fork();
    if (caller == 0) {
        (void)open("/dev/zero", O_RDONLY); // NOLINT(android-cloexec-open): on purpose
        sigset_t some;
        sigemptyset(&some);
        sigaddset(&some, SIGUSR1);
        sigaddset(&some, SIGALRM);
        pthread_sigmask(SIG_BLOCK, &some, nullptr);
        (void)run_mesher(input, {});
        _exit(0);
    }
    const pid_t helper = helper_of(caller);
    REQUIRE(helper > 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(200)); // the helper is at work
    CHECK(runs(helper));
    const auto folder = fs::path("/proc") / std::to_string(helper);
    for (const auto& entry : fs::directory_iterator(folder / "fd"))
        CHECK(fs::read_symlink(entry) != "/dev/zero");
    std::string status;
    std::ifstream file(folder / "status");
    while (file >> status && status != "SigBlk:") {
    }
    unsigned long blocked = 0;
    file >> std::hex >> blocked;
    const auto bit = [](int signal) { return 1UL << static_cast<unsigned>(signal - 1); };
    CHECK(blocked == (bit(SIGINT) | bit(SIGTERM) | bit(SIGHUP)));

    kill(caller, SIGKILL);
    waitpid(caller, nullptr, 0);
    while (runs(helper)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST_CASE("TetGen's helper: several at once, while other threads allocate and start programs",
          "[tetrahedra][helper]") {
    const fs::path helper = find_tetgen_helper().value();
    std::atomic<int> filled = 0;
    {
        std::vector<std::jthread> threads;
        threads.emplace_back([](const std::stop_token& stop) { // a thread with its own children
            while (!stop.stop_requested()) std::vector<char>(100'000 + std::system("true"));
        });
        std::vector<std::jthread> fillers;
        for (int k = 0; k < 4; ++k)
            fillers.emplace_back([&] {
                for (int round = 0; round < 20; ++round) filled += cube_is_filled(helper) ? 1 : 0;
            });
        fillers.clear();
    }
    CHECK(filled == 80);
}
