// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests what all commands have in common: exit statuses, streams, and that failures leave no files.
#include <catch2/catch.hpp>

#include "program.hpp"
#include "support/effort.hpp"

using namespace program_test;

namespace {

/// Checks that a command fails properly: with the status, a message, no output and no new file.
void refused(const Folder& folder, const std::string& arguments, int status,
             const std::string& message) {
    INFO(arguments);
    const auto before = folder.left();
    const auto r = folder.run(arguments);
    CHECK(r.status == status);
    CHECK(r.out.empty());
    INFO(r.err);
    CHECK(contains(r.err, message));
    CHECK(folder.left() == before);
}

} // namespace

TEST_CASE("cli: help names each command and how it is used", "[cli]") {
    const Folder folder;
    const auto help = folder.run("--help");
    CHECK(help.status == 0);
    CHECK(help.err.empty());
    for (const std::string command : {"arrange", "check", "tetrahedralize", "convert"}) {
        CHECK(contains(help.out, "\n  " + command + " "));
        const auto r = folder.run(command + " --help");
        CHECK(r.status == 0);
        CHECK(contains(r.out, "Examples:\n  terrane " + command));
    }
    CHECK(contains(help.out, "Exit status: 0 done; 1"));
    const auto version = folder.run("--version");
    CHECK(version.status == 0);
    CHECK(contains(version.out, "terrane 0.1.0\n"));
}

TEST_CASE("cli: wrong usage ends with status 2, before any work", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    refused(folder, "", 2, "subcommand is required");
    refused(folder, "explode " + in, 2, "there is no command explode");
    refused(folder, "arrange", 2, "required");
    refused(folder, "arrange " + in, 2, "--output is required");
    refused(folder, "arrange " + in + " -o out.obj --search quick", 2, "--search");
    refused(folder, "arrange " + in + " -o out.obj --threads many", 2, "--threads");
    refused(folder, "arrange " + in + " -o out.obj --rounds 9", 2, "--rounds");
    refused(folder, "arrange missing.obj -o out.abc", 2, "out.abc: no format");
    refused(folder, "arrange missing.obj -o out", 2, "out: no format");
    refused(folder, "arrange missing.obj -o out.vtu", 2, "for tetrahedra");
    refused(folder, "arrange missing.obj -o no/out.obj", 2, "no/out.obj: there is no folder no");
    refused(folder, "arrange missing.obj -o in", 2, "in: no format");
    refused(folder, "arrange missing.obj -o out.obj --stats no/s.json", 2, "there is no folder");
    refused(folder, "arrange missing.obj -o out.obj", 2, "missing.obj: cannot be read");
    refused(folder, "arrange - -o out.obj", 2, "the format must be given");
    refused(folder, "arrange - - --format ts -o out.obj", 2, "only once");
    refused(folder, "arrange " + in + " -o -", 2, "the format must be given");
    refused(folder, "arrange " + in + " -o - --format obj --stats -", 2, "only one file");
    refused(folder, "arrange " + in + " -o - --format abc", 2, "unknown format abc");
    refused(folder, "convert " + in + " out.obj --output-format abc", 2, "unknown format abc");
    refused(folder, "convert " + in, 2, "OUT is required");
    refused(folder, "check in", 2, "in: ");
}

TEST_CASE("cli: bad files are named with the line, and nothing is written", "[cli]") {
    const Folder folder;
    const std::string good = "v 0 0 0\nv 1 0 0\n";
    const auto with = [&](const std::string& rest) { return folder.input("bad.obj", good + rest); };
    for (const std::string command : {"arrange $ -o out.obj", "check $", "convert $ out.vtp"}) {
        const auto on = [&](const std::string& file) {
            auto line = command;
            return line.replace(line.find('$'), 1, file);
        };
        refused(folder, on(with("v 0 nan 0\nf 1 2 3\n")), 2, "terrane: in/bad.obj:3: ");
        refused(folder, on(with("v 0 1\nf 1 2 3\n")), 2, "terrane: in/bad.obj:3: ");
        refused(folder, on(with("v 0 1 0\nf 1 2 4\n")), 2, "terrane: in/bad.obj:4: ");
        refused(folder, on(with("v 0 1 1e999\nf 1 2 3\n")), 2, "terrane: in/bad.obj:3: ");
        refused(folder, on(folder.input("empty.obj", "")), 2, "terrane: in/empty.obj: ");
        refused(folder, on(folder.input("empty.stl", "")), 2, "terrane: in/empty.stl: ");
        refused(folder, on(folder.input("a.vtp", "x")), 2, "in/a.vtp:1: this is not well-formed");
        refused(folder, on(folder.input("a.inp", "x")), 2, "in/a.inp: this format is written");
    }
}

TEST_CASE("cli: what cannot be written leaves the old file, and no other", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    refused(folder, "convert " + in + " /dev/full --output-format obj", 2, "/dev/full: writing");
    const auto full = folder.shell("$T check " + in + " >/dev/full");
    CHECK(full.status == 2);
    CHECK(contains(full.err, "standard output: not all could be written"));
    const auto closed = folder.shell("$T convert $D/ringmesh/modelA1.ml - --format obj 2>io/pipe |"
                                     " head -n 1 >/dev/null; cat io/pipe");
    CHECK(contains(closed.out, "standard output: writing failed: Broken pipe"));

    CHECK(folder
              .shell("echo old >out.obj && ulimit -f 1 && trap '' XFSZ &&"
                     " $T convert $D/ringmesh/modelA1.ml out.obj")
              .status == 2);
    CHECK(folder.read("out.obj") == "old\n");
    CHECK(folder.left() == std::set<std::string>{"out.obj"});
}

TEST_CASE("cli: standard input and output", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    REQUIRE(folder.run("arrange " + in + " -o out.obj").status == 0);
    const auto piped = folder.shell("$T arrange - -o - --format obj <" + in);
    CHECK(piped.status == 0);
    CHECK(piped.out == folder.read("out.obj"));
    CHECK(contains(piped.err, "verified: ")); // the summary goes to standard error
    const auto chain = folder.shell("$T convert " + in +
                                    " - --format ts | $T arrange - -o - --format ts "
                                    "--output-format off | $T check - --format off");
    CHECK(chain.status == 0);
    CHECK(contains(chain.out, "standard input: 1 surface, 13 triangles"));
}

TEST_CASE("cli: an interrupt ends the program with status 2 and no file", "[cli]") {
    const Folder folder;
    const auto waiting = folder.shell("mkfifo in/p; $K INT waits $T check - --format ts <>in/p");
    CHECK(waiting.status == 2);
    CHECK(contains(waiting.err, "terrane: interrupted, nothing written"));
    const auto in = folder.input("model.obj", crossing);
    const auto computing = folder.shell("$K TERM waits $T tetrahedralize " + in +
                                        " -o out.vtu --edge-length 0.02 --quality 1.1");
    CHECK(computing.status == 2);
    CHECK(contains(computing.err, "terrane: interrupted, nothing written"));
    CHECK(folder.left().empty());
}

#ifndef TERRANE_SANITIZED
TEST_CASE("cli: without memory it ends with status 3 and no file", "[cli]") {
    const Folder folder;
    const auto run_within = [&](int kib, const std::string& arguments) {
        return folder.shell("ulimit -v " + std::to_string(kib) + " && $T " + arguments);
    };
    const std::string arrange = "arrange $D/arch-platform/faults.ts $D/arch-platform/mnt.ts "
                                "-o out.vtp --threads 1";
    // The smallest numbers of megabytes in which the program starts, and in which it arranges.
    const auto least = [&](int from, const std::string& arguments) {
        for (int mib = from; mib < 1000; ++mib)
            if (run_within(1024 * mib, arguments).status == 0) return mib;
        return 1000;
    };
    const int starts = least(1, "--version"), ends = least(starts, arrange);
    CAPTURE(starts, ends);
    REQUIRE(ends < 1000);
    REQUIRE(ends > starts + 8); // otherwise the test would be too easy
    REQUIRE(folder.shell("rm out.vtp").status == 0);
    std::set<std::string> messages;
    for (int mib = starts + 1; mib < ends - 1; mib += 2) { // addresses vary from run to run
        const auto r = run_within(1024 * mib, arrange);
        INFO(mib << ": " << r.err);
        CHECK(r.status == 3);
        CHECK(folder.left().empty());
        CHECK((contains(r.err, "memory") || contains(r.err, "resources")));
        messages.insert(r.err);
    }
    CHECK(messages.size() > 2); // it ran out in several places
}

TEST_CASE("cli: where TetGen gets no memory, the program says so", "[cli]") {
    const Folder folder;
    const auto in = folder.input("model.obj", crossing);
    // A script in place of the helper limits the memory of the helper alone.
    folder.input("helper", "#!/bin/sh\nulimit -v 40000\nexec \"${T%/*}/../libexec/terrane/"
                           "terrane-tetgen\"\n");
    const auto r = folder.shell("chmod +x in/helper && export T && TERRANE_TETGEN=in/helper $T "
                                "tetrahedralize " +
                                in + " -o out.vtu --edge-length 0.02");
    INFO(r.err);
    CHECK(r.status == 3);
    CHECK(contains(r.err, "TetGen ran out of memory"));
    CHECK(folder.left().empty());
}
#endif
