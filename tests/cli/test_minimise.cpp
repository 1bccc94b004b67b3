// SPDX-License-Identifier: LGPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

using program_test::contains;
using program_test::crossing;
using program_test::Folder;

TEST_CASE("minimise: any command decides what is left, by the way in which it ends") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    auto outcome = folder.run("minimise --test '! grep -q \"^v 4 \" {}' " + in + " -o a.obj");
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.out, "a.obj: 1 of 3 triangles after "));
    CHECK(contains(outcome.out, ", status 1\n"));
    CHECK(contains(folder.read("a.obj"), "v 4 0 0\n"));
    CHECK_FALSE(contains(folder.read("a.obj"), "v 4 4 0\n"));
    CHECK(contains(folder.read("a.obj"), "horizon"));

    // Two triangles are left, as without one of them the status is another one.
    outcome = folder.run(
        "minimise --test 'grep -q fault {} || exit 3; grep -q horizon {} || exit 4; exit 7' " + in +
        " -o b.obj --quiet");
    CHECK(outcome.status == 0);
    CHECK(outcome.out.empty());
    CHECK(contains(folder.read("b.obj"), "horizon"));
    CHECK(contains(folder.read("b.obj"), "fault"));
    CHECK(folder.shell("test $(grep -c ^f b.obj) = 2").status == 0);

    outcome = folder.run("minimise --test \"$T check --quiet\" " + in + " -o c.off");
    CHECK(outcome.status == 0); // the file is appended
    CHECK(folder.run("check --quiet c.off").status == 1);
    CHECK(folder.run("minimise --test 'kill -9 $$' " + in + " -o d.obj").status == 0);
    CHECK(folder.left() == std::set<std::string>{"a.obj", "b.obj", "c.off", "d.obj"});
}

TEST_CASE("minimise: a command that does not end is ended, with what it started") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    const auto outcome =
        folder.run("minimise --time 0.3 --test 'sleep 77 & sleep 78 # {}' " + in + " -o a.obj");
    CHECK(outcome.status == 0);
    CHECK(contains(outcome.out, "no end within the limit"));
    CHECK(folder.shell("! pgrep -f '^sleep 7[78]'").status == 0);
}

TEST_CASE("minimise: nothing is written where nothing fails, or cannot be tried") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    auto outcome = folder.run("minimise --test true " + in + " -o a.obj");
    CHECK(outcome.status == 1);
    CHECK(contains(outcome.err, "status 0"));
    outcome = folder.run("minimise --test no_such_engine " + in + " -o a.obj");
    CHECK(outcome.status == 2);
    CHECK(contains(outcome.err, "--test: the shell cannot run this command"));
    CHECK(folder.run("minimise --test -1 " + in + " -o a.obj").status == 2);
    CHECK(folder.run("minimise --test '' " + in + " -o a.obj").status == 2);
    CHECK(folder.run("minimise " + in + " -o a.obj").status == 2);
    CHECK(folder.run("minimise --test false none.obj -o a.obj").status == 2);
    CHECK(folder.run("minimise --test false " + in + " -o a.vtu").status == 2);
    CHECK(folder.run("minimise --test false --time 0 " + in + " -o a.obj").status == 2);
    CHECK(folder.shell("TMPDIR=/none $T minimise --test false " + in + " -o a.obj").status == 2);
    CHECK(folder.left().empty());
}

TEST_CASE("minimise: an interrupt ends it and the command, and leaves nothing behind") {
    const Folder folder;
    const auto in = folder.input("crossing.obj", crossing);
    const auto outcome = folder.shell("mkdir io/tmp; TMPDIR=$PWD/io/tmp $K TERM waits $T minimise "
                                      "--time 99 --test 'sleep 79; false' " +
                                      in + " -o a.obj");
    CHECK(outcome.status == 2);
    CHECK(folder.left().empty());
    CHECK(folder.shell("test -z \"$(ls io/tmp)\" && ! pgrep -f '^sleep 79'").status == 0);
}
