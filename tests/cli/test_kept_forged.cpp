// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that `terrane build --resume` takes only what this user's runs kept, by the user's key.
#include <set>
#include <string>

#include <unistd.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "boxed_project.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

/// Two horizons that run through each other: with --strict a run ends with an error after its stages.
struct Crossed : Case {
    Json json = boxed_project();

    Crossed() {
        auto crossing = layers;
        crossing.replace(crossing.find("9 9 5"), 5, "9 9 1");
        folder.input("layers.obj", crossing);
        json["improve"] = {{"edge_length", 3}};
    }
    /// Keeps the stages of a run in a folder, out.stages by default.
    void keep(const std::string& state = "io/state", const std::string& out = "out") const {
        const std::string set = "XDG_STATE_HOME=\"$PWD/" + state + "\" ";
        const auto kept = folder.shell(set + "$T build " + folder.input("p.json", json.dump()) +
                                       " --strict --resume -o " + out);
        INFO(kept.err);
        REQUIRE(kept.status == 2);
        REQUIRE(contains(kept.err, "finished stages are kept in " + out + ".stages"));
    }
    [[nodiscard]] Outcome resume(const std::string& before = "true") const {
        return folder.shell(before + "; $T build in/p.json -o out --resume");
    }
    [[nodiscard]] bool as_in_one_go() const {
        REQUIRE(build(json, "-o whole").status == 0);
        return folder.shell("diff -r -x log.txt -x statistics.json whole out").status == 0;
    }
};

constexpr auto key = "io/state/terrane/stages.key";

} // namespace

TEST_CASE("cli: build --resume makes a key for its user alone", "[cli][resume][key]") {
    const Crossed c;
    c.keep();
    CHECK(c.folder.shell("stat -c '%a %s' io/state/terrane/stages.key io/state/terrane")
              .out.substr(0, 10) == "600 32\n700");
    CHECK(c.folder.shell("ls -A io/state/terrane").out == "stages.key\n");
    const auto first = c.folder.read(key);
    const auto r = c.resume();
    CHECK(r.status == 0);
    CHECK(contains(r.out, "taken from out.stages\n"));
    CHECK(c.folder.read(key) == first);
    CHECK(c.as_in_one_go());
    c.keep("io/elsewhere", "again");
    CHECK(c.folder.read("io/elsewhere/terrane/stages.key") != first);
}

TEST_CASE("cli: runs that make a key at once have the same", "[cli][resume][key]") {
    const Crossed c;
    c.folder.input("p.json", c.json.dump());
    const auto all =
        c.folder.shell("for i in 1 2 3 4 5 6 7 8; do $T build in/p.json --strict --resume "
                       "-o out$i & done; wait");
    REQUIRE(all.status == 0);
    CHECK(c.folder.shell("ls -A io/state/terrane").out == "stages.key\n");
    const auto r =
        c.folder.shell("for i in 1 2 3 4 5 6 7 8; do $T build in/p.json --resume -o out$i "
                       "|| exit 1; done");
    CHECK(r.status == 0);
    CHECK_FALSE(contains(r.err, "is run again"));
}

TEST_CASE("cli: build --resume takes no stage that was kept otherwise", "[cli][resume][key]") {
    Crossed c;
    std::string why;
    SECTION("by another user") {
        c.keep("io/other");
        why = "damaged, or not kept by this user on this machine";
    }
    SECTION("of a sibling project") {
        const auto own = c.json;
        c.json["improve"] = {{"edge_length", 2}};
        c.keep();
        c.json = own;
        c.folder.input("p.json", c.json.dump());
        why = "made from other surfaces or options, or by another version";
    }
    SECTION("with other contents") {
        c.keep();
        REQUIRE(c.folder.shell("printf x | dd of=out.stages/improve bs=1 seek=5000 conv=notrunc")
                    .status == 0);
        why = "damaged";
    }
    SECTION("under another version") {
        c.keep();
        REQUIRE(c.folder.shell("sed -i '1s/terrane [0-9]/terrane 9/' out.stages/improve").status ==
                0);
        why = "damaged, or not kept by this user on this machine";
    }
    SECTION("as a link") {
        c.keep();
        REQUIRE(
            c.folder.shell("mv out.stages/improve io/ && ln -s ../io/improve out.stages/").status ==
            0);
        why = "is a link";
    }
    SECTION("as a pipe") {
        c.keep();
        REQUIRE(c.folder.shell("rm out.stages/improve && mkfifo out.stages/improve").status == 0);
        why = "is no regular file";
    }
    SECTION("as a file of terabytes") {
        c.keep();
        REQUIRE(c.folder.shell("truncate -s 4T out.stages/improve").status == 0);
        why = "damaged";
    }
    const auto r = c.resume();
    INFO(r.err);
    CHECK(r.status == 0);
    CHECK(contains(r.err, "warning: out.stages/improve: " + why + "; the stage is run again\n"));
    CHECK_FALSE(contains(r.out, "taken from"));
    CHECK(c.as_in_one_go());
}

TEST_CASE("cli: build --resume writes through no link", "[cli][resume][key]") {
    const Crossed c;
    REQUIRE(c.folder
                .shell("echo mine > io/mine && mkdir out.stages && ln -s ../io/mine "
                       "out.stages/improve")
                .status == 0);
    c.keep();
    CHECK(c.folder.read("io/mine") == "mine\n");
    CHECK(c.folder.shell("test ! -L out.stages/improve").status == 0);
}

TEST_CASE("cli: build --resume keeps and takes nothing without a key of its own",
          "[cli][resume][key]") {
    const Crossed c;
    c.keep();
    const auto [change, why] = GENERATE(table<std::string, std::string>({
        {"chmod g+r io/state/terrane/stages.key", "others may use it"},
        {"chmod o+x io/state/terrane", "others may use it"},
        {"truncate -s 31 io/state/terrane/stages.key", "is no key of 32 bytes"},
        {"truncate -s 1G io/state/terrane/stages.key", "is no key of 32 bytes"},
        {"mv io/state/terrane/stages.key io/ && ln -s \"$PWD/io/stages.key\" io/state/terrane/",
         "is a link"},
        {"mv io/state/terrane io/ && ln -s \"$PWD/io/terrane\" io/state/", "is a link"},
        {"rm io/state/terrane/stages.key && mkfifo -m 600 io/state/terrane/stages.key",
         "is no regular file"},
        {"rm -r io/state/terrane && touch io/state/terrane", "is no folder"},
        {"export XDG_STATE_HOME=/proc/1/terrane", "cannot be made"},
        {"unset XDG_STATE_HOME HOME", "neither XDG_STATE_HOME nor HOME names a folder"},
        {"unset XDG_STATE_HOME && export HOME=/nonexistent", "names a folder"},
        {"export XDG_STATE_HOME=io/state HOME=relative", "names a folder"},
    }));
    const auto r = c.resume(change);
    INFO(change << "\n" << r.err);
    CHECK(r.status == 0);
    CHECK(contains(r.err, why));
    CHECK(contains(r.err, "; --resume neither keeps stages nor takes any\n"));
    CHECK_FALSE(contains(r.out, "taken from"));
    CHECK(c.as_in_one_go());
}

TEST_CASE("cli: build --resume uses no key of another user", "[cli][resume][key]") {
    const Crossed c;
    c.keep();
    if (::geteuid() != 0) return; // only root gives files away
    const auto r = c.resume(
        GENERATE("chown 65534 io/state/terrane/stages.key", "chown 65534 io/state/terrane"));
    CHECK(r.status == 0);
    CHECK(contains(r.err, "belongs to another user; --resume neither keeps"));
}

TEST_CASE("cli: build --resume finds the key in the home directory", "[cli][resume][key]") {
    const Crossed c;
    c.folder.input("p.json", c.json.dump());
    const auto r =
        c.folder.shell("unset XDG_STATE_HOME; HOME=\"$PWD/io\" $T build in/p.json -o out "
                       "--resume");
    CHECK(r.status == 0);
    CHECK(c.folder
              .shell("stat -c %a io/.local io/.local/state io/.local/state/terrane "
                     "io/.local/state/terrane/stages.key")
              .out == "700\n700\n700\n600\n");
}
