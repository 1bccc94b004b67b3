// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests `terrane build --resume` from outside.
#include <set>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "boxed_project.hpp"
#include "program.hpp"

using namespace program_test;

namespace {

/// A project whose last stage fails, as the helper of its mesher is replaced by `false`.
struct Interrupted : Case {
    Json json = boxed_project();
    Outcome failed;

    Interrupted() {
        json["improve"] = {{"edge_length", 1.5}};
        json["tetrahedra"] = {{"mesher", "tetgen"}};
        json["outputs"]["tetrahedra"] = {"vtu"};
        folder.input("p.json", json.dump(2));
        failed = folder.shell("TERRANE_TETGEN=/bin/false $T build in/p.json -o out --resume");
    }
    [[nodiscard]] Outcome resume() const { return build(json, "-o out --resume"); }
    /// Tells whether the results are those of a run in one go.
    [[nodiscard]] bool as_in_one_go() const {
        REQUIRE(build(json, "-o whole").status == 0);
        return folder.shell("diff -r -x log.txt -x statistics.json whole out").status == 0;
    }
};

} // namespace

#ifdef TERRANE_HAS_TETGEN

TEST_CASE("cli: build --resume takes the stages that had ended", "[cli][resume]") {
    const Interrupted c;
    INFO(c.failed.err);
    CHECK(c.failed.status != 0);
    CHECK(contains(c.failed.err,
                   "terrane: finished stages are kept in out.stages; --resume goes on "
                   "from there\n"));
    CHECK(c.folder.left() == std::set<std::string>{"out.stages"});
    const auto r = c.resume();
    INFO(r.err);
    REQUIRE(r.status == 0);
    CHECK(r.err.empty());
    CHECK(contains(r.out, "improve\ntaken from out.stages\nquality "));
    const auto statistics = Json::parse(c.folder.read("out/statistics.json"));
    CHECK(statistics["resumed"] == Json({"improve"}));
    CHECK(contains(c.folder.read("out/log.txt"), "taken from out.stages\n"));
    CHECK(c.folder.left() == std::set<std::string>{"out"}); // nothing is kept after a good end
    CHECK(c.as_in_one_go());
}

TEST_CASE("cli: build --resume takes no stage that other options would make otherwise",
          "[cli][resume][once]") {
    Interrupted c;
    SECTION("another length") {
        c.json["improve"]["edge_length"] = 2;
    }
    SECTION("another length on one surface") {
        c.json["improve"]["edge_length_of"] = {{"top", 1}};
    }
    SECTION("other surfaces") {
        auto moved = layers;
        moved.replace(moved.find("9 9 5"), 5, "9 9 5.5");
        c.folder.input("layers.obj", moved);
    }
    const auto r = c.resume();
    REQUIRE(r.status == 0);
    CHECK(contains(r.err, "warning: out.stages/improve: made from other surfaces or options, or by "
                          "another version; the stage is run again\n"));
    CHECK_FALSE(contains(r.out, "taken from"));
    CHECK(c.as_in_one_go());
}

TEST_CASE("cli: build --resume takes nothing that was damaged", "[cli][resume]") {
    const Interrupted c;
    const auto change =
        GENERATE(as<std::string>(), "truncate -s -1", "truncate -s 40", "truncate -s 0",
                 "dd if=/dev/zero conv=notrunc bs=1 seek=5000 "
                 "count=64 status=none of=");
    const auto damaged =
        c.folder.shell(change + (change.ends_with('=') ? "" : " ") + "out.stages/improve");
    REQUIRE(damaged.status == 0);
    const auto r = c.resume();
    REQUIRE(r.status == 0);
    CHECK(contains(r.err, "warning: out.stages/improve: damaged; the stage is run again\n"));
    CHECK(c.as_in_one_go());
}

#endif

TEST_CASE("cli: build --resume leaves files of others", "[cli][resume]") {
    const Case c;
    REQUIRE(c.folder.shell("mkdir out.stages && echo > out.stages/note.txt").status == 0);
    REQUIRE(c.build(boxed_project(), "-o out --resume").status == 0);
    CHECK(c.folder.shell("ls out.stages").out == "note.txt\n");
}

TEST_CASE("cli: build without --resume keeps nothing and takes nothing", "[cli][resume]") {
    const Case c;
    auto json = boxed_project();
    json["improve"] = {{"edge_length", 1.5}};
    REQUIRE(c.folder.shell("mkdir out.stages && echo wrong > out.stages/improve").status == 0);
    const auto r = c.build(json);
    CHECK(r.status == 0);
    CHECK(r.err.empty());
    CHECK(c.folder.shell("ls out.stages").out == "improve\n");
}
