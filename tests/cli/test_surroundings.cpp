// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests the program in unusual surroundings: closed streams, outputs in impossible places, signals
// that its caller blocks.
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "program.hpp"

using namespace program_test;

namespace {

/// An empty folder of this machine at which something is mounted; empty if there is none.
std::string empty_mount_point() {
    std::ifstream mounts("/proc/self/mounts");
    for (std::string device, place, rest;
         mounts >> device >> place && std::getline(mounts, rest);) {
        std::error_code failed;
        if (fs::is_directory(place, failed) && fs::is_empty(place, failed) && !failed) return place;
    }
    return {};
}

} // namespace

TEST_CASE("cli: a closed standard output is missed by those files alone that go there",
          "[cli][surroundings]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    REQUIRE(folder.run("arrange " + in + " -o a.obj").status == 0);
    for (const std::string closed : {"<&-", ">&-", "2>&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        CHECK(folder.shell("$T arrange " + in + " -o b.obj " + closed).status == 0);
        CHECK(folder.shell("cmp a.obj b.obj && rm b.obj").status == 0);
        CHECK(folder.shell("$T check " + in + " " + closed).status ==
              1); // the answer is the status
    }
    const auto out = folder.shell("$T arrange missing.obj -o - --format obj >&-");
    CHECK(out.status == 2);
    CHECK(contains(out.err, "terrane: standard output: cannot be written: it is closed"));
    const auto input = folder.shell("$T convert - b.obj --format obj <&-");
    CHECK(input.status == 2);
    CHECK(contains(input.err, "terrane: standard input: cannot be read"));
    CHECK(folder.left() == std::set<std::string>{"a.obj"});
}

TEST_CASE("cli: a folder that cannot become the output is refused before any work",
          "[cli][surroundings]") {
    const Folder folder;
    REQUIRE(folder
                .shell("mkdir empty full in/real && touch full/file a_file && ln -s in/real link &&"
                       " ln -s nowhere dangling")
                .status == 0);
    const auto before = folder.left();
    struct Bad {
        std::string name, message;
    };
    std::vector<Bad> bad{{"link", "link: this is a link"},
                         {"link/", "link/: this is a link"},
                         {"dangling", "dangling: this is a link"},
                         {".", ".: the folder in which the program runs"},
                         {"./", "./: the folder in which the program runs"},
                         {"..", "..: the folder in which the program runs"},
                         {"$PWD", "the folder in which the program runs"},
                         {"full", "full: the folder is there already and not empty"},
                         {"full/.", "full/.: the folder is there already and not empty"},
                         {"a_file", "a_file: this is no folder"},
                         {"/dev/null", "/dev/null: this is no folder"},
                         {"no/out", "no/out: there is no folder no"},
                         {"a_file/out", "a_file/out: there is no folder a_file"},
                         {"/proc/out", "/proc/out: "}, // not even root can make it
                         {std::string(256, 'n'), "the folder cannot be made: File name too long"}};
    if (const auto mounted = empty_mount_point(); !mounted.empty())
        bad.push_back({mounted, mounted + ": something is mounted at this folder"});
    for (const auto& [name, message] : bad) {
        const auto r = folder.run("volume missing.obj -o " + name);
        INFO(name << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, message));
        CHECK_FALSE(contains(r.err, "missing.obj"));
        CHECK(folder.left() == before);
    }
    // These will do; so the missing input is what is wrong.
    for (const std::string name : {"empty", "empty/", "empty/.", "new", "full/new"}) {
        const auto r = folder.run("volume missing.obj -o " + name);
        INFO(name << ": " << r.err);
        CHECK(contains(r.err, "missing.obj: cannot be read"));
    }
    CHECK(folder.left() == before);
}

TEST_CASE("cli: a file that cannot become an output is refused before any work",
          "[cli][surroundings]") {
    const Folder folder;
    REQUIRE(folder
                .shell("ln -s no/x.obj lost.obj && ln -s self.obj self.obj && mkdir in/d.obj && "
                       "touch in/file")
                .status == 0);
    struct Bad {
        std::string name, message;
    };
    for (const auto& [name, message] : std::vector<Bad>{
             {"lost.obj", "lost.obj: this is a link into a folder that is not there"},
             {"self.obj", "self.obj: cannot be written: Too many levels of symbolic links"},
             {"in/d.obj", "in/d.obj: this is a folder"},
             {"in/file/x.obj", "in/file/x.obj: there is no folder in/file"},
             {"no/x.obj", "no/x.obj: there is no folder no"},
             {std::string(256, 'n') + ".obj", "cannot be written: File name too long"}}) {
        const auto r = folder.run("convert missing.obj " + name);
        INFO(name << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, message));
    }
    // A link to a file that is not there yet is kept, and the file is made.
    const auto in = folder.input("model.obj", crossing);
    REQUIRE(folder.shell("ln -s in/made.obj good.obj && $T convert " + in + " good.obj").status ==
            0);
    CHECK(folder.shell("test -L good.obj && test -s in/made.obj").status == 0);
}

TEST_CASE("cli: interrupts are heard although the caller blocks them", "[cli][surroundings]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    // The signal is pending when the program begins, and the program inherits the mask.
    for (const std::string name : {"INT", "TERM", "HUP"}) {
        const auto r = folder.shell("/usr/bin/python3 -c 'import os, signal, sys; "
                                    "signal.signal(signal.SIG" +
                                    name +
                                    ", signal.SIG_DFL); "
                                    "signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIG" +
                                    name +
                                    "]); "
                                    "os.kill(os.getpid(), signal.SIG" +
                                    name +
                                    "); "
                                    "os.execv(sys.argv[1], sys.argv[1:])' $T volume " +
                                    in + " -o out --box -1,-2,-2,5,6,4");
        INFO(name << ": " << r.err);
        CHECK(r.status == 2);
        CHECK(contains(r.err, "terrane: interrupted, nothing written"));
        CHECK(folder.left().empty());
    }
}
